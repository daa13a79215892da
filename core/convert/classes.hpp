/**
 * @file classes.hpp
 * Which elements of a source share shape and spaces.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

struct TargetClass {
    native::Space geometry;
    /** One for each converted field. */
    std::vector<native::Space> fields;
    /** Whether the source's space lies in the target's, for every element. */
    std::vector<bool> is_contained;
    /** Source numbers, ascending. */
    std::vector<std::uint64_t> elements;
};

/** Classes in the order of their first elements. `fields`: indices of the converted fields in the source. */
std::vector<TargetClass> target_classes(const SourceVolume& source, const std::vector<std::uint32_t>& fields,
                                        const ConvertOptions& options, const TaskControl& control);

} // namespace elvis
