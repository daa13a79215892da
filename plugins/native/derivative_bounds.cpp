/*
 * Bounds of a field's derivatives in elements, from weights of the device functions.
 */
#include "derivative_weights.hpp"
#include "volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::native_plugin {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/** What rounding of all coefficients to single precision changes at most, relative to the sum of their weights: 2^-24. */
constexpr double single_rounding = 6e-8;

double finite_or_unknown(double bound) { return std::isfinite(bound) ? bound : unknown; }

} // namespace

void Volume::derivative_bounds(std::size_t field, std::size_t time_step, std::uint64_t first, std::uint64_t count,
                               std::span<double> bounds) const {
    const std::size_t n_components = description().fields[field].n_components;
    // Rational functions.
    if (description().fields[field].transform != native::Transform::none) {
        std::fill(bounds.begin(), bounds.end(), unknown);
        return;
    }
    for_each_run(first, count, [&](std::size_t element_class, std::uint64_t local, std::uint64_t n_run, std::uint64_t offset) {
        const Conversion& convert = conversion(field_space(element_class, field));
        const auto& [weights, bernstein] = bounders(field_space(element_class, field));
        const std::size_t n_modes = convert.n_native();
        const std::uint64_t at_once = std::max<std::uint64_t>(1, (std::size_t{1} << 19) / (n_components * n_modes));
        std::vector<double> modes(n_modes);
        for (std::uint64_t done = 0; done < n_run; done += at_once) {
            m_host.check_cancelled();
            const std::uint64_t n = std::min(at_once, n_run - done);
            const std::vector<double> coefficients = read_field(field, time_step, element_class, local + done, n);
            for (std::uint64_t i = 0; i < n * n_components; ++i) {
                const auto native = std::span<const double>(coefficients).subspan(i * n_modes, n_modes);
                convert.apply(native, modes);
                clean_apex(convert.device_space(), native, modes);
                DerivativeBound bound = weights.bound(modes);
                if (bernstein.is_usable()) {
                    const DerivativeBound other = bernstein.bound(modes);
                    bound.first = std::min(bound.first, other.first + single_rounding * bound.first);
                    bound.second = std::min(bound.second, other.second + single_rounding * bound.second);
                }
                double* out = bounds.data() + ((offset + done) * n_components + i) * 2;
                out[0] = finite_or_unknown(bound.first);
                out[1] = finite_or_unknown(bound.second);
            }
        }
    });
}

} // namespace elvis::native_plugin
