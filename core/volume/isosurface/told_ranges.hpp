/**
 * @file told_ranges.hpp
 * In which elements a field may take given values, as far as a plugin proves it.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

/** The number whose isosurfaces are drawn, and what it lacks on the device. */
struct ToldField {
    std::uint32_t field = 0;
    /** -1: the length of the vector. */
    std::int32_t component = 0;
    std::uint32_t time_step = 0;
    double offset = 0;

    /** Of the ranges of an element's components. */
    FieldRange range_of(std::span<const FieldRange> components) const;
};

/** `values` ascending. A range that is no number, as of an element with such values, says nothing. */
bool holds_any(const FieldRange& range, std::span<const double> values);

/**
 * The range with what is beyond its ends by no more than rounding: of evaluations in single precision lacking an offset of at
 * most this size, so that of an isosurface in a face both elements beside it are looked at.
 */
FieldRange beyond_rounding(const FieldRange& range, double offset);

/**
 * Of all elements of a class, less the offset and beyond rounding; unbounded where the plugin does not prove it. Empty if it
 * tells none. `check` may throw, and is asked on the way.
 */
std::vector<FieldRange> told_ranges(Background& background, const RuntimeVolume& volume, std::uint32_t element_class,
                                    const ToldField& field, const std::function<void()>& check);

} // namespace elvis
