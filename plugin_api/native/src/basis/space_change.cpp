#include "space_change.hpp"

#include "../file/runs.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <tuple>

namespace elvis::native {
namespace {

using device::Matrix;

bool is_lagrange(const Space& space) { return space.basis == Basis::gll_lagrange || space.basis == Basis::gauss_lagrange; }

std::array<std::uint32_t, 3> larger(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
    return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}

/** A mode by its factors. Those of modal bases are the same functions in spaces of every order. */
using FactorKey = std::tuple<Kind, int, int, int>;
using ModeKey = std::array<FactorKey, 3>;

FactorKey key_of(const Factor& factor) { return {factor.kind, factor.m, factor.index, factor.power}; }

std::vector<ModeKey> modes_of(const Space& space) {
    std::vector<ModeKey> modes;
    for_each_run(space, [&modes](const Run& run) {
        Factor inner = run.inner;
        for (int i = 0; i < run.count; ++i, ++inner.index)
            modes.push_back({key_of(run.outer), key_of(run.mid), key_of(inner)});
    });
    return modes;
}

/** Empty if some mode of `from` is not among those of `to`. */
std::vector<std::size_t> places_in(const Space& from, const Space& to) {
    std::map<ModeKey, std::size_t> known;
    for (const ModeKey& mode : modes_of(to))
        known.emplace(mode, known.size());
    std::vector<std::size_t> places;
    for (const ModeKey& mode : modes_of(from)) {
        const auto found = known.find(mode);
        if (found == known.end())
            return {};
        places.push_back(found->second);
    }
    return places;
}

/** Values of all modes, a row a point. */
Matrix values_at(const Space& space, const std::vector<Point>& points) {
    Matrix values(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(n_modes(space)));
    for (std::size_t i = 0; i < points.size(); ++i)
        evaluate_modes(space, points[i], {values.row(static_cast<Eigen::Index>(i)).data(), n_modes(space)});
    return values;
}

/** Where the function of each mode is 1 and those of the others are 0. */
std::vector<Point> lobatto_nodes(const Space& space) {
    std::array<std::vector<double>, 3> along;
    for (std::size_t d = 0; d < 3; ++d) {
        along[d].assign(space.order[d] + 1, 0.0);
        if (space.order[d] > 0)
            gauss_lobatto_legendre(along[d]);
    }
    std::vector<Point> nodes;
    for (const double third : along[2])
        for (const double second : along[1])
            for (const double first : along[0])
                nodes.push_back({first, second, third});
    return nodes;
}

/** Gauss points in collapsed coordinates: as many as determine the functions of the space. */
std::vector<Point> gauss_points(const Space& space) {
    const std::array<std::uint32_t, 3> degrees = collapsed_order(space);
    std::array<std::vector<double>, 3> along;
    for (std::size_t d = 0; d < 3; ++d) {
        along[d].resize(degrees[d] + 1);
        std::vector<double> weights(along[d].size());
        gauss_legendre(along[d], weights);
    }
    std::vector<Point> points;
    for (const double first : along[0])
        for (const double second : along[1])
            for (const double third : along[2])
                points.push_back(expand(space.shape, {first, second, third}));
    return points;
}

} // namespace

Space common_space(const Space& a, const Space& b) {
    assert(a.shape == b.shape);
    if (is_constant(a) || is_constant(b) || a == b)
        return is_constant(a) ? b : a;
    if (is_lagrange(a) || is_lagrange(b))
        return {a.shape, Basis::gll_lagrange, larger(a.order, b.order)};
    if (a.basis == b.basis)
        return {a.shape, a.basis, larger(a.order, b.order)};
    if (a.shape == Shape::pyramid)
        return {a.shape, Basis::tensor, larger(collapsed_order(a), collapsed_order(b))};
    return {a.shape, Basis::modified, larger(a.order, b.order)};
}

SpaceChange::SpaceChange(const Space& from, const Space& to) {
    if (from == to || !(is_lagrange(from) || is_lagrange(to)))
        m_places = places_in(from, to);
    if (!m_places.empty())
        return;
    if (to.basis == Basis::gll_lagrange) {
        m_matrix = values_at(from, lobatto_nodes(to));
    } else {
        const std::vector<Point> points = gauss_points(to);
        m_matrix = Eigen::HouseholderQR<Eigen::MatrixXd>(values_at(to, points)).solve(values_at(from, points));
    }
}

void SpaceChange::add(std::span<const double> coefficients, double scale, std::span<double> sum) const {
    if (!m_places.empty()) {
        for (std::size_t mode = 0; mode < m_places.size(); ++mode)
            sum[m_places[mode]] += scale * coefficients[mode];
        return;
    }
    assert(static_cast<Eigen::Index>(sum.size()) == m_matrix.rows());
    Eigen::Map<Eigen::VectorXd>(sum.data(), m_matrix.rows()) +=
        scale * (m_matrix * Eigen::Map<const Eigen::VectorXd>(coefficients.data(), m_matrix.cols()));
}

} // namespace elvis::native
