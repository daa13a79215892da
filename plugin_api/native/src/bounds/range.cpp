/*
 * Certified ranges: a polynomial lies between its smallest and largest Bernstein coefficient (Farin, Curves and Surfaces for
 * CAGD); where these are far apart, values at nodes bound it, too (node_bounds.hpp). Rounding is bounded as
 * bernstein_tables.hpp says.
 */
#include "../file/runs.hpp"
#include "bernstein_tables.hpp"
#include "node_bounds.hpp"
#include "numbers.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

namespace elvis::native {

struct RangeBounder::Tables {
    bool convex = false; // modes are >= 0 and sum to 1: the range is that of the coefficients
    std::optional<BernsteinTables> forms;
    std::optional<NodeBounds> nodes;

    explicit Tables(const Space& space);
};

namespace {

std::shared_ptr<const RangeBounder::Tables> tables_of(const Space& space) {
    static std::mutex mutex;
    static std::map<std::tuple<Shape, Basis, std::array<std::uint32_t, 3>>, std::shared_ptr<const RangeBounder::Tables>> cache;
    const std::lock_guard lock(mutex);
    auto& entry = cache[{space.shape, space.basis, space.order}];
    if (!entry)
        entry = std::make_shared<const RangeBounder::Tables>(space);
    return entry;
}

} // namespace

RangeBounder::Tables::Tables(const Space& space) {
    const bool nodal = space.basis == Basis::modified || space.basis == Basis::tensor || space.basis == Basis::gll_lagrange;
    convex = is_constant(space) || (nodal && *std::max_element(space.order.begin(), space.order.end()) == 1);
    if (convex)
        return;
    forms.emplace(space);
    nodes.emplace(Sizes{forms->size_outer, forms->size_mid, forms->size_inner});
}

RangeBounder::RangeBounder(const Space& space) : m_tables(tables_of(space)) {
    if (!m_tables->convex)
        m_workspace.resize(std::max(m_tables->forms->workspace_size(), m_tables->nodes->workspace_size()) +
                           m_tables->forms->size());
}

Range RangeBounder::operator()(std::span<const double> coefficients) {
    const Tables& t = *m_tables;
    Range result{infinity, -infinity};
    if (t.convex) {
        double sum = 0; // not finite if any coefficient is not
        for (const double c : coefficients) {
            sum += c - c;
            result = {std::min(result.lower, c), std::max(result.upper, c)};
        }
        return sum == 0 ? result : Range{-infinity, infinity};
    }
    assert(coefficients.size() == t.forms->weights.size());
    double magnitude = 0;
    for (std::size_t mode = 0; mode < coefficients.size(); ++mode)
        magnitude += std::abs(coefficients[mode]) * t.forms->weights[mode];
    // Infinity and NaN, and numbers so large that an intermediate result could overflow (no matrix entry reaches 1e100).
    if (!(magnitude < 1e200))
        return {-infinity, infinity};
    if (magnitude == 0)
        return {0, 0};
    // Underflow costs each product at most the smallest subnormal number, 5e-324, times the matrices that follow.
    const double error = t.forms->gamma * magnitude + 1e-200;

    double* const sum = m_workspace.data() + (m_workspace.size() - t.forms->size());
    t.forms->transform<1>(coefficients.data(), m_workspace.data(), sum);
    for (std::size_t k = 0; k < t.forms->size(); ++k)
        result = {std::min(result.lower, sum[k]), std::max(result.upper, sum[k])};
    if (const std::optional<Range> other = t.nodes->operator()(sum, result, error, m_workspace.data()))
        return {std::max(result.lower - error, other->lower), std::min(result.upper + error, other->upper)};
    return {result.lower - error, result.upper + error};
}

Range range(const Space& space, std::span<const double> coefficients) { return RangeBounder(space)(coefficients); }

} // namespace elvis::native
