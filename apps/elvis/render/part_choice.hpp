/**
 * @file part_choice.hpp
 * What --parts says.
 */
#pragma once

#include "render_options.hpp"
#include "volume_to_part.hpp"

#include <core/parts/partition.hpp>

namespace elvis::commands {

/** Throws UsageError for options that do not go with --parts, and for several processes without it. */
void check_parts(const RenderArguments& arguments, bool is_animation);

/** Parts of a volume. Throws Error for a file that does not say a part of each element, and where the volume has no partition
 * of its own. */
Partition partition_of(const RenderArguments& arguments, const VolumeToPart& volume);

} // namespace elvis::commands
