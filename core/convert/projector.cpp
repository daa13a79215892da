#include <core/convert/projector.hpp>

#include <Eigen/QR>

#include <cmath>

namespace elvis {

namespace {

/** Calls visit(eta, index triple) over a tensor grid. */
template <class Visit> void for_each_point(const std::array<std::vector<double>, 3>& along, Visit&& visit) {
    for (std::size_t k = 0; k < along[2].size(); ++k) {
        for (std::size_t j = 0; j < along[1].size(); ++j) {
            for (std::size_t i = 0; i < along[0].size(); ++i) {
                visit(native::Point{along[0][i], along[1][j], along[2][k]}, i, j, k);
            }
        }
    }
}

/** Volume of the reference shape for one of the collapsed cube, at eta: product of (1 - eta_j)/2 for what is collapsed. */
double collapse_factor(native::Shape shape, const native::Point& eta) {
    const double second = 0.5 * (1 - eta[1]);
    const double third = 0.5 * (1 - eta[2]);
    switch (shape) {
    case native::Shape::prism:
        return third;
    case native::Shape::pyramid:
        return third * third;
    case native::Shape::tetrahedron:
        return second * third * third;
    case native::Shape::triangle:
        return second;
    default:
        return 1;
    }
}

void append(PointList& list, const native::Point& point) { list.insert(list.end(), point.begin(), point.end()); }

} // namespace

GaussPoints gauss_points(native::Shape shape, const std::array<std::uint32_t, 3>& n) {
    std::array<std::vector<double>, 3> along, weights;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        if (direction == 2 && native::dimension(shape) == 2) {
            along[2] = {0.0};
            weights[2] = {1.0};
            continue;
        }
        along[direction].resize(n[direction]);
        weights[direction].resize(n[direction]);
        native::gauss_legendre(along[direction], weights[direction]);
    }
    GaussPoints points;
    for_each_point(along, [&](const native::Point& eta, std::size_t i, std::size_t j, std::size_t k) {
        append(points.xi, native::expand(shape, eta));
        points.weights.push_back(weights[0][i] * weights[1][j] * weights[2][k] * collapse_factor(shape, eta));
    });
    return points;
}

PointList check_points(native::Shape shape, std::uint32_t n) {
    std::vector<double> equidistant(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        equidistant[i] = -1 + 2.0 * i / (n - 1);
    }
    std::array<std::vector<double>, 3> along = {equidistant, equidistant, equidistant};
    if (native::dimension(shape) == 2) {
        along[2] = {0.0};
    }
    PointList points;
    for_each_point(along, [&](const native::Point& eta, std::size_t, std::size_t, std::size_t) {
        append(points, native::expand(shape, eta));
    });
    return points;
}

Eigen::MatrixXd mode_matrix(const native::Space& space, const PointList& xi) {
    const std::size_t n_points = xi.size() / 3;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> modes(
        static_cast<Eigen::Index>(n_points), static_cast<Eigen::Index>(native::n_modes(space)));
    for (std::size_t point = 0; point < n_points; ++point) {
        native::evaluate_modes(
            space, {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]},
            std::span<double>(modes.row(static_cast<Eigen::Index>(point)).data(), static_cast<std::size_t>(modes.cols())));
    }
    return modes;
}

Eigen::MatrixXd projection_matrix(const native::Space& space, const GaussPoints& points) {
    const Eigen::VectorXd root =
        Eigen::Map<const Eigen::VectorXd>(points.weights.data(), static_cast<Eigen::Index>(points.weights.size())).cwiseSqrt();
    const Eigen::MatrixXd weighted = root.asDiagonal() * mode_matrix(space, points.xi);
    const Eigen::Index n_points = weighted.rows();
    return Eigen::MatrixXd(weighted.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(n_points, n_points))) *
           root.asDiagonal();
}

} // namespace elvis
