/**
 * @file tolerances.hpp
 * What a picture may be off without saying so: one table, which the page of the tool repeats.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/vulkan/precision.hpp>

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace elvis::hunt {

struct Tolerances {
    /** Of every channel: published (core/numerics.md). The others are not; they are some tens of roundings of the precision. */
    double color = 0;
    /** Distance of the shown position from the surface, over the volume's diagonal plus the depth. */
    double position = 0;
    /** Of values, over the field's range, on top of what the position's tolerance makes of them. */
    double field = 0;
    /** |difference| of unit normals where the gradient is as large as range / element size; more where it is less. */
    double normal = 0;
    /** What rounding may do to positions (over diagonal plus depth) and fields (over the range): a pixel whose answer such a
     * change turns is decided by rounding. */
    double position_rounding = 0, field_rounding = 0;
};

/** The oracle computes in double precision, too: what rounding decides there it cannot tell. */
inline Tolerances tolerances_of(Precision precision) {
    return precision == Precision::float32 ? Tolerances{1e-3, 1e-5, 2e-5, 1e-3, 4e-6, 1e-5}
                                           : Tolerances{1e-9, 1e-12, 1e-12, 1e-9, 1e-13, 2e-13};
}

/** Bits of what can be wrong in a pixel. */
namespace buffer {
inline constexpr unsigned color = 1, value = 2, depth = 4, normal = 8, element = 16, surface = 32, flags = 64, contour = 128,
                          mesh_line = 256;
inline const std::vector<std::pair<unsigned, std::string_view>> names{
    {color, "color"},     {value, "value"}, {depth, "depth"},     {normal, "normal"},      {element, "element"},
    {surface, "surface"}, {flags, "flags"}, {contour, "contour"}, {mesh_line, "mesh_line"}};
} // namespace buffer

struct FlagName {
    std::uint32_t bit;
    std::string_view name;
};

/** Flags that say that something may be wrong. */
inline const std::vector<FlagName> named_flags{{pixel_flag::contour_undecided, "contour_undecided"},
                                               {pixel_flag::mesh_line_undecided, "mesh_line_undecided"},
                                               {pixel_flag::newton_failure, "newton_failure"},
                                               {pixel_flag::nan, "nan"},
                                               {pixel_flag::isosurface_undecided, "isosurface_undecided"},
                                               {pixel_flag::volume_tolerance, "volume_tolerance"},
                                               {pixel_flag::undecided, "undecided"},
                                               {pixel_flag::work_limit, "work_limit"},
                                               {pixel_flag::estimated, "estimated"},
                                               {pixel_flag::range_too_fine, "range_too_fine"},
                                               {pixel_flag::overlap, "overlap"}};

/** Whichever of these is set covers all of a pixel's buffers. Those of lines cover nothing else. */
inline constexpr std::uint32_t covering_bits() {
    return pixel_flag::newton_failure | pixel_flag::nan | pixel_flag::isosurface_undecided | pixel_flag::volume_tolerance |
           pixel_flag::undecided | pixel_flag::work_limit | pixel_flag::estimated | pixel_flag::range_too_fine |
           pixel_flag::overlap;
}

} // namespace elvis::hunt
