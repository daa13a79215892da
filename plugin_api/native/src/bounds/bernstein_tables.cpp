#include "bernstein_tables.hpp"

#include "bernstein.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace elvis::native {
namespace {

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

} // namespace

BernsteinTables::BernsteinTables(const Space& space) {
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
    // The sum of n terms |c| w is itself low by at most n units.
    const double slack = 1 + static_cast<double>(weights.size() + 4) * 2 * unit;
    gamma = n_roundings * unit / (1 - n_roundings * unit) * slack;
}

} // namespace elvis::native
