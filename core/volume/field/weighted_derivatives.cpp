#include <core/volume/field/weighted_derivatives.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

elvis_certainty read_weighted_derivatives(const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field,
                                          std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                          std::span<DerivativeBounds> out) {
    if (volume.classes()[element_class].shape == ELVIS_SHAPE_PYRAMID && volume.has_apex_bounds()) {
        return volume.apex_bounds(field, time_step, first, count, out);
    }
    if (volume.has_derivative_bounds()) {
        return volume.derivative_bounds(field, time_step, first, count, out);
    }
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::ranges::fill(out, DerivativeBounds{unknown, unknown});
    return ELVIS_ESTIMATED;
}

} // namespace elvis
