/**
 * @file weighted_derivatives.hpp
 * What a plugin proves of derivatives, in the form that models of fields take.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <span>

namespace elvis {

/**
 * L and H of elements of one class; in pyramids B >= t H in place of H, t = (1 - xi_3)/2, as second derivatives may grow
 * without bound towards the apex. Of elvis_apex_bounds where the plugin offers it; where it does not, H itself is a B, as t is
 * at most 1. NaN where the plugin cannot tell.
 */
elvis_certainty read_weighted_derivatives(const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field,
                                          std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                          std::span<DerivativeBounds> out);

} // namespace elvis
