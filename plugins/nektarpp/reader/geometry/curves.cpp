#include "curves.hpp"

#include "../field/nodal_triangle.hpp"

namespace nektarpp {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
namespace native = elvis::native;

MatrixXd points_of(const Curve& curve) {
    MatrixXd points(static_cast<Index>(curve.points.size()), 3);
    for (std::size_t point = 0; point < curve.points.size(); ++point) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            points(static_cast<Index>(point), static_cast<Index>(axis)) = curve.points[point][axis];
        }
    }
    return points;
}

Position row_of(const MatrixXd& modes, Index row) { return {modes(row, 0), modes(row, 1), modes(row, 2)}; }

std::vector<double> line_points(PointSet set, std::uint32_t n) {
    std::vector<double> z(n);
    if (set == PointSet::gauss_lobatto) {
        native::gauss_lobatto_legendre(z);
        return z;
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        z[k] = -1 + 2.0 * k / (n - 1);
    }
    return z;
}

} // namespace

const CurveFitter::Lu& CurveFitter::line(PointSet set, std::uint32_t n) {
    const auto found = m_lines.find({set, n});
    if (found != m_lines.end()) {
        return found->second;
    }
    // The modes A_p(z) are the first of a quadrilateral at (z, -1), where the other factor A_0 is 1.
    const native::Space space{Shape::quadrilateral, native::Basis::modified, {n - 1, 1, 0}};
    const std::vector<double> z = line_points(set, n);
    std::vector<double> values(native::n_modes(space));
    MatrixXd matrix(n, n);
    for (std::uint32_t point = 0; point < n; ++point) {
        native::evaluate_modes(space, {z[point], -1, 0}, values);
        for (std::uint32_t mode = 0; mode < n; ++mode) {
            matrix(point, mode) = values[mode];
        }
    }
    return m_lines.emplace(Key{set, n}, matrix.partialPivLu()).first->second;
}

Bubble CurveFitter::fit_edge(const Curve& curve) {
    Bubble bubble{curve.n_along, {}};
    const MatrixXd modes = line(curve.set, curve.n_along).solve(points_of(curve));
    for (Index mode = 2; mode < modes.rows(); ++mode) {
        bubble.modes.push_back(row_of(modes, mode));
    }
    return bubble;
}

Bubble CurveFitter::fit_quadrilateral(const Curve& curve) {
    const Lu& lu = line(curve.set, curve.n_along);
    const auto n = static_cast<Index>(curve.n_along);
    const MatrixXd points = points_of(curve);
    std::array<MatrixXd, 3> modes;
    for (Index axis = 0; axis < 3; ++axis) {
        // Column j holds row j of the points: along the first direction.
        const MatrixXd along_first = lu.solve(points.col(axis).reshaped(n, n));
        modes[static_cast<std::size_t>(axis)] = lu.solve(along_first.transpose()).transpose();
    }
    Bubble bubble{curve.n_along, {}};
    for_each_bubble_mode(curve.n_along, 4, [&](std::uint32_t i, std::uint32_t j) {
        bubble.modes.push_back({modes[0](i, j), modes[1](i, j), modes[2](i, j)});
    });
    return bubble;
}

std::optional<Bubble> CurveFitter::fit_triangle(const Curve& curve) {
    const native::Space space{Shape::triangle, native::Basis::modified, {curve.n_along - 1, curve.n_along - 1, 0}};
    auto& lu = m_triangles[{curve.set, curve.n_along}];
    if (!lu) {
        const auto points = triangle_points(curve.set, curve.n_along);
        if (!points) {
            return std::nullopt;
        }
        std::vector<double> values(native::n_modes(space));
        MatrixXd matrix(static_cast<Index>(points->size()), static_cast<Index>(values.size()));
        for (std::size_t point = 0; point < points->size(); ++point) {
            native::evaluate_modes(space, {(*points)[point][0], (*points)[point][1], 0}, values);
            matrix.row(static_cast<Index>(point)) =
                Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Index>(values.size()));
        }
        lu = std::make_unique<Lu>(matrix);
    }
    const MatrixXd modes = lu->solve(points_of(curve));
    Bubble bubble{curve.n_along, {}};
    // Mode (p, q) of a triangle with q fastest, q < n - p.
    Index first = 0;
    for (std::uint32_t i = 0; i < curve.n_along; ++i) {
        for (std::uint32_t j = 0; i + j < curve.n_along; ++j) {
            if (i >= 2 && j >= 1) {
                bubble.modes.push_back(row_of(modes, first + j));
            }
        }
        first += curve.n_along - i;
    }
    return bubble;
}

} // namespace nektarpp
