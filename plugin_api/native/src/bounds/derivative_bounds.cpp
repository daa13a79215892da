#include <elvis/native/derivative_bounds.hpp>

#include "bernstein_bounds.hpp"
#include "pyramid_bounds.hpp"

#include <elvis/native/conversion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace elvis::native {
namespace {

/** What rounding of all coefficients to single precision changes at most, relative to the sum of their weights: 2^-24. */
constexpr double single_rounding = 6e-8;

double finite_or_unknown(double bound) { return std::isfinite(bound) ? bound : std::numeric_limits<double>::quiet_NaN(); }

} // namespace

struct DerivativeBounder::Forms {
    device::Conversion conversion;
    device::DerivativeWeights weights;
    device::BernsteinBounds bernstein;
    std::optional<PyramidBounds> pyramid;

    Forms(const Space& space, SecondDerivatives second)
        : conversion(space), weights(conversion.device_space(), second), bernstein(conversion.device_space()) {
        if (second == SecondDerivatives::apex_weighted && PyramidBounds::has_bounds(space))
            pyramid.emplace(space);
    }
};

DerivativeBounder::DerivativeBounder(const Space& space, SecondDerivatives second)
    : m_forms(std::make_shared<const Forms>(space, second)) {}

DerivativeBound DerivativeBounder::operator()(std::span<const double> coefficients) const {
    thread_local std::vector<double> modes;
    modes.resize(coefficients.size());
    m_forms->conversion.apply(coefficients, modes);
    device::clean_apex(m_forms->conversion.device_space(), coefficients, modes);
    DerivativeBound bound = m_forms->weights.bound(modes);
    const auto take = [&bound](const DerivativeBound& other) {
        bound.first = std::min(bound.first, other.first + single_rounding * bound.first);
        bound.second = std::min(bound.second, other.second + single_rounding * bound.second);
    };
    if (m_forms->bernstein.is_usable())
        take(m_forms->bernstein.bound(modes));
    if (m_forms->pyramid)
        take(m_forms->pyramid->bound(coefficients));
    return {finite_or_unknown(bound.first), finite_or_unknown(bound.second)};
}

} // namespace elvis::native
