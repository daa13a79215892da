/**
 * @file field_extrema.hpp
 * The smallest and the largest value of a field over all elements: as the plugin tells them (elvis/extrema.h), else searched
 * for.
 *
 * Branch and bound over boxes in collapsed coordinates. With c the middle of a box and r_i the reach of its image around xi(c),
 * Taylor's theorem along the straight line from c, which stays in the convex reference shape, gives
 *
 *   |f(xi) - f(c)| <= sum_i |df/dxi_i(c)| r_i + H/2 max_i r_i^2                     H >= sum_ij |d^2 f / dxi_i dxi_j|
 *
 * with H from elvis_runtime.get_field_derivative_bounds, in pyramids B of elvis_apex_bounds over the least (1 - xi_3)/2 in the
 * box. Near the apex L max_i r_i bounds it. Where a plugin proves no H, elements are sampled, and the best samples are refined
 * on ever finer lattices; the answer is then an estimate.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <optional>
#include <span>

namespace elvis {

/** Distance that values of the field may keep from the extrema, over that of the two. */
inline constexpr double extrema_tolerance = 1e-3;

/**
 * Of a component, or of the magnitude (-1) of a field with several: from the plugin if it tells, else by the search. Nothing if
 * only the device could tell: the plugin evaluates nothing on the CPU, or elements are only parts of their reference shape. May
 * take long: `control` is asked meanwhile.
 */
std::optional<FieldExtrema> find_extrema(const RuntimeVolume& volume, std::uint32_t field, int component,
                                         std::uint32_t time_step, const TaskControl* control = nullptr);

/** The search alone, whatever the plugin tells. The volume must have CPU evaluation. */
FieldExtrema search_extrema(const RuntimeVolume& volume, std::uint32_t field, int component, std::uint32_t time_step,
                            const TaskControl* control = nullptr);

/** Of the magnitude of a field whose components have these ranges. */
FieldRange magnitude_range(std::span<const FieldRange> components);

} // namespace elvis
