/*
 * Certified ranges: a polynomial lies between its smallest and largest Bernstein coefficient (Farin, Curves and Surfaces for
 * CAGD).
 *
 * Per run, inner factors are summed first, then mid, then outer ones. The computed coefficients differ from the exact ones by
 * at most gamma_K sum_m |c_m| w_m, w_m being the product of the largest Bernstein coefficients of the mode's three factors and
 * K the number of roundings on the way of a term: its products, the additions of the three sums, the matrices' own error
 * (Higham, Accuracy and Stability of Numerical Algorithms, 3.1).
 */
#include "bernstein.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>

namespace elvis::native {

struct RangeBounder::Tables {
    // A run of coefficients with the places of its matrices.
    struct Part {
        std::size_t first, count, inner, mid;
    };
    // Parts that share an outer factor.
    struct Group {
        std::size_t outer;
        std::vector<Part> parts;
    };

    std::size_t size_outer = 1, size_mid = 1, size_inner = 1; // Bernstein coefficients a direction
    std::vector<Group> groups;
    std::vector<double> matrices;
    std::vector<double> weights; // w_m
    double gamma = 0;            // gamma_K, rounded up
    bool convex = false;         // modes are >= 0 and sum to 1: the range is that of the coefficients

    explicit Tables(const Space& space);
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Computes each factor once.
class MatrixBuilder {
public:
    MatrixBuilder(std::vector<double>& values, std::uint32_t order, std::size_t size)
        : m_values(values), m_order(order), m_size(size) {}

    // The rows of `count` consecutive indices, one after the other; the bound of each is written to `bounds`.
    std::size_t rows(Factor factor, std::size_t count, std::vector<double>& bounds) {
        const auto key = std::tuple(factor.kind, factor.m, factor.index, factor.power, count);
        auto [position, is_new] = m_entries.try_emplace(key);
        if (is_new) {
            auto& entry = position->second;
            entry.first = m_values.size();
            m_values.resize(entry.first + count * m_size);
            for (std::size_t i = 0; i < count; ++i, ++factor.index)
                entry.second.push_back(
                    bernstein(factor, m_order, std::span(m_values).subspan(entry.first + i * m_size, m_size)));
        }
        bounds = position->second.second;
        return position->second.first;
    }

private:
    std::vector<double>& m_values;
    std::uint32_t m_order;
    std::size_t m_size;
    std::map<std::tuple<Kind, int, int, int, std::size_t>, std::pair<std::size_t, std::vector<double>>> m_entries;
};

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
    const auto degrees = collapsed_order(space);
    const Directions axis = directions(space.shape);
    size_outer = degrees[axis.outer] + 1;
    size_mid = degrees[axis.mid] + 1;
    size_inner = degrees[axis.inner] + 1;
    MatrixBuilder outer(matrices, space.order[axis.outer], size_outer);
    MatrixBuilder mid(matrices, space.order[axis.mid], size_mid);
    MatrixBuilder inner(matrices, space.order[axis.inner], size_inner);

    weights.resize(n_modes(space));
    std::map<std::size_t, std::size_t> group_of; // by place of the outer factor
    std::size_t longest = 1;
    for_each_run(space, [&](const Run& run) {
        const auto count = static_cast<std::size_t>(run.count);
        longest = std::max(longest, count);
        std::vector<double> outer_bound, mid_bound, inner_bounds;
        const std::size_t outer_place = outer.rows(run.outer, 1, outer_bound);
        const std::size_t mid_place = mid.rows(run.mid, 1, mid_bound);
        const std::size_t inner_place = inner.rows(run.inner, count, inner_bounds);
        const auto [position, is_new] = group_of.try_emplace(outer_place, groups.size());
        if (is_new)
            groups.push_back({outer_place, {}});
        groups[position->second].parts.push_back({run.first, count, inner_place, mid_place});
        for (std::size_t i = 0; i < count; ++i)
            weights[run.first + i] = outer_bound[0] * mid_bound[0] * inner_bounds[i];
    });
    std::size_t largest_group = 1;
    for (const Group& group : groups)
        largest_group = std::max(largest_group, group.parts.size());
    // Additions of the three sums, three products, one unit for each of three matrices, two for the final subtraction; 8 more
    // for the roundings of the bound itself.
    const auto n_roundings = static_cast<double>(longest + largest_group + groups.size() + 3 + 3 + 2 + 8);
    constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
    // The sum of n terms |c| w is itself low by at most n units.
    const double slack = 1 + static_cast<double>(weights.size() + 4) * 2 * unit;
    gamma = n_roundings * unit / (1 - n_roundings * unit) * slack;
}

RangeBounder::RangeBounder(const Space& space) : m_tables(tables_of(space)) {
    const Tables& t = *m_tables;
    if (!t.convex)
        m_workspace.resize(t.size_inner + t.size_mid * t.size_inner + t.size_outer * t.size_mid * t.size_inner);
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
    assert(coefficients.size() == t.weights.size());
    double magnitude = 0;
    for (std::size_t mode = 0; mode < coefficients.size(); ++mode)
        magnitude += std::abs(coefficients[mode]) * t.weights[mode];
    // Infinity and NaN, and numbers so large that an intermediate result could overflow (no matrix entry reaches 1e100).
    if (!(magnitude < 1e200))
        return {-infinity, infinity};
    if (magnitude == 0)
        return {0, 0};
    // Underflow costs each product at most the smallest subnormal number, 5e-324, times the matrices that follow.
    const double error = t.gamma * magnitude + 1e-200;

    const std::size_t n = t.size_inner;
    const std::size_t plane = t.size_mid * n;
    double* const line_sum = m_workspace.data();
    double* const plane_sum = line_sum + n;
    double* const sum = plane_sum + plane;
    std::fill_n(sum, t.size_outer * plane, 0.0);
    for (const Tables::Group& group : t.groups) {
        std::fill_n(plane_sum, plane, 0.0);
        for (const Tables::Part& part : group.parts) {
            std::fill_n(line_sum, n, 0.0);
            const double* row = t.matrices.data() + part.inner;
            for (std::size_t i = 0; i < part.count; ++i, row += n) {
                const double c = coefficients[part.first + i];
                for (std::size_t k = 0; k < n; ++k)
                    line_sum[k] += c * row[k];
            }
            const double* mid = t.matrices.data() + part.mid;
            for (std::size_t j = 0; j < t.size_mid; ++j)
                for (std::size_t k = 0; k < n; ++k)
                    plane_sum[j * n + k] += mid[j] * line_sum[k];
        }
        const double* outer = t.matrices.data() + group.outer;
        for (std::size_t i = 0; i < t.size_outer; ++i)
            for (std::size_t k = 0; k < plane; ++k)
                sum[i * plane + k] += outer[i] * plane_sum[k];
    }
    for (std::size_t k = 0; k < t.size_outer * plane; ++k)
        result = {std::min(result.lower, sum[k]), std::max(result.upper, sum[k])};
    return {result.lower - error, result.upper + error};
}

Range range(const Space& space, std::span<const double> coefficients) { return RangeBounder(space)(coefficients); }

} // namespace elvis::native
