/*
 * Bounds of a field's derivatives in elements.
 */
#include "volume.hpp"

#include <algorithm>
#include <limits>

namespace elvis::native_plugin {

void Volume::derivative_bounds(std::size_t field, std::size_t time_step, native::SecondDerivatives second, std::uint64_t first,
                               std::uint64_t count, std::span<double> bounds) const {
    const std::size_t n_components = description().fields[field].n_components;
    // Rational functions.
    if (description().fields[field].transform != native::Transform::none) {
        std::fill(bounds.begin(), bounds.end(), std::numeric_limits<double>::quiet_NaN());
        return;
    }
    for_each_run(first, count, [&](std::size_t element_class, std::uint64_t local, std::uint64_t n_run, std::uint64_t offset) {
        const native::DerivativeBounder& bounder = derivative_bounder(field_space(element_class, field), second);
        const std::size_t n_modes = native::n_modes(field_space(element_class, field));
        const std::uint64_t at_once = std::max<std::uint64_t>(1, (std::size_t{1} << 19) / (n_components * n_modes));
        for_each_block(n_run, at_once, [&](std::uint64_t done, std::uint64_t n) {
            const std::vector<double> coefficients = read_field(field, time_step, element_class, local + done, n);
            for (std::uint64_t i = 0; i < n * n_components; ++i) {
                const native::DerivativeBound bound = bounder(std::span(coefficients).subspan(i * n_modes, n_modes));
                double* out = bounds.data() + ((offset + done) * n_components + i) * 2;
                out[0] = bound.first;
                out[1] = bound.second;
            }
        });
    });
}

} // namespace elvis::native_plugin
