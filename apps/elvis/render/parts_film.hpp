/**
 * @file parts_film.hpp
 * Animations of volumes that are drawn in parts.
 */
#pragma once

#include "render_options.hpp"
#include "volume_to_part.hpp"

#include <core/parts/partition.hpp>
#include <core/vulkan/device.hpp>

namespace elvis::commands {

/**
 * Processes beyond the number of parts are further groups, each of which draws pictures of its own: every picture is drawn by
 * one group. Their bytes do not depend on that. Called by all of the team.
 */
void render_parts_film(const RenderArguments& arguments, const Scene& scene, const VolumeToPart& volume, const Device& device,
                       Partition partition, DivisibleTeam& team, const TaskControl& control);

} // namespace elvis::commands
