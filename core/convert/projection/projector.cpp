#include <core/convert/projection/projector.hpp>

#include <Eigen/QR>

#include <algorithm>
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

void append(PointList& list, const native::Point& point) { list.insert(list.end(), point.begin(), point.end()); }

} // namespace

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

PointList check_points(native::Shape shape, std::size_t n) {
    PointList points;
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        append(points, native::corner(shape, corner));
    }
    // The root of g^4 = g + 1, whose powers spread most evenly in three dimensions.
    constexpr double g = 1.22074408460575947536;
    for (std::size_t index = 0; index < n; ++index) {
        native::Point eta{};
        double step = 1;
        for (double& coordinate : eta) {
            step /= g;
            // Stretched a little and cut off, so that faces and edges get points too.
            const double spread = std::fmod(0.5 + step * static_cast<double>(index + 1), 1.0);
            coordinate = std::clamp(1.15 * (2 * spread - 1), -1.0, 1.0);
        }
        if (native::dimension(shape) == 2) {
            eta[2] = 0;
        }
        append(points, native::expand(shape, eta));
    }
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

Eigen::MatrixXd fit_matrix(const Eigen::MatrixXd& modes, std::span<const double> weights) {
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(weights.data(), modes.rows()).cwiseSqrt();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * modes);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(modes.rows(), modes.cols());
    const Eigen::MatrixXd inverse = qr.matrixQR().topRows(modes.cols()).triangularView<Eigen::Upper>().solve(q.transpose());
    return inverse * root.asDiagonal();
}

namespace {

/**
 * Fit of the functions A_first .. A_order of one direction at its Gauss points, weighted by l(z)^collapse. They are the first
 * modes of a hexahedron where the other two factors are A_0(-1) = 1.
 */
Eigen::MatrixXd line_fit(std::uint32_t order, std::uint32_t n, int collapse, std::uint32_t first = 0) {
    std::vector<double> z(n), weights(n);
    native::gauss_legendre(z, weights);
    PointList xi;
    for (std::size_t i = 0; i < n; ++i) {
        append(xi, {z[i], -1, -1});
        weights[i] *= std::pow(0.5 * (1 - z[i]), collapse);
    }
    const native::Space space{native::Shape::hexahedron, native::Basis::modified, {order, 1, 1}};
    return fit_matrix(mode_matrix(space, xi).middleCols(first, order + 1 - first), weights);
}

/** Matrix of a product of three fits. Modes with the first index fastest, or the last; points with the first index fastest. */
Eigen::MatrixXd product(const std::array<Eigen::MatrixXd, 3>& fits, bool first_mode_is_fastest) {
    const auto& [a, b, c] = fits;
    Eigen::MatrixXd result(a.rows() * b.rows() * c.rows(), a.cols() * b.cols() * c.cols());
    for (Eigen::Index k = 0; k < c.cols(); ++k) {
        for (Eigen::Index j = 0; j < b.cols(); ++j) {
            for (Eigen::Index i = 0; i < a.cols(); ++i) {
                double* column = result.col(i + a.cols() * (j + b.cols() * k)).data();
                for (Eigen::Index p = 0; p < a.rows(); ++p) {
                    for (Eigen::Index q = 0; q < b.rows(); ++q) {
                        for (Eigen::Index r = 0; r < c.rows(); ++r) {
                            const Eigen::Index mode =
                                first_mode_is_fastest ? p + a.rows() * (q + b.rows() * r) : r + c.rows() * (q + b.rows() * p);
                            column[mode] = a(p, i) * b(q, j) * c(r, k);
                        }
                    }
                }
            }
        }
    }
    return result;
}

/** The triangles (xi1, xi3) of a prism times its axis xi2. Modes p, q, r <= R - p; points with the first index fastest. */
Eigen::MatrixXd prism_product(const native::Space& space, const std::array<std::uint32_t, 3>& n) {
    const Eigen::MatrixXd axis = line_fit(space.order[1], n[1], 0);
    std::vector<double> z1(n[0]), w1(n[0]), z3(n[2]), w3(n[2]);
    native::gauss_legendre(z1, w1);
    native::gauss_legendre(z3, w3);
    PointList xi;
    std::vector<double> weights;
    for (std::size_t k = 0; k < n[2]; ++k) {
        for (std::size_t i = 0; i < n[0]; ++i) {
            append(xi, native::expand(native::Shape::prism, {z1[i], -1, z3[k]}));
            weights.push_back(w1[i] * w3[k] * 0.5 * (1 - z3[k]));
        }
    }
    // Modes with q = 0 of a prism of order 1 along its axis, where A_0(-1) = 1.
    const native::Space thin{space.shape, space.basis, {space.order[0], 1, space.order[2]}};
    const Eigen::MatrixXd all = mode_matrix(thin, xi);
    std::vector<Eigen::Index> triangle_modes;
    std::vector<Eigen::Index> run_lengths;
    Eigen::Index at = 0;
    for (std::uint32_t p = 0; p <= space.order[0]; ++p) {
        run_lengths.push_back(space.order[2] - p + 1);
        for (Eigen::Index r = 0; r < run_lengths.back(); ++r) {
            triangle_modes.push_back(at + r);
        }
        at += 2 * run_lengths.back();
    }
    const Eigen::MatrixXd triangle = fit_matrix(all(Eigen::all, triangle_modes), weights);

    Eigen::MatrixXd result(static_cast<Eigen::Index>(native::n_modes(space)), n[0] * n[1] * n[2]);
    Eigen::Index mode = 0;
    Eigen::Index first = 0;
    for (const Eigen::Index length : run_lengths) {
        for (Eigen::Index q = 0; q < axis.rows(); ++q) {
            for (Eigen::Index r = 0; r < length; ++r, ++mode) {
                for (Eigen::Index k = 0; k < n[2]; ++k) {
                    for (Eigen::Index j = 0; j < n[1]; ++j) {
                        for (Eigen::Index i = 0; i < n[0]; ++i) {
                            result(mode, i + n[0] * (j + n[1] * k)) = triangle(first + r, i + n[0] * k) * axis(q, j);
                        }
                    }
                }
            }
        }
        first += length;
    }
    return result;
}

} // namespace

PointProjection element_projection(const native::Space& space, const std::array<std::uint32_t, 3>& n) {
    GaussPoints points = gauss_points(space.shape, n);
    const auto& order = space.order;
    const bool is_modified = space.basis == native::Basis::modified && order[0] > 0;
    PointProjection result;
    if (space.shape == native::Shape::hexahedron && is_modified) {
        result.matrix = product({line_fit(order[0], n[0], 0), line_fit(order[1], n[1], 0), line_fit(order[2], n[2], 0)}, true);
    } else if (space.shape == native::Shape::prism && is_modified) {
        result.matrix = prism_product(space, n);
    } else if (space.basis == native::Basis::tensor && order[0] > 0) {
        result.matrix = product({line_fit(order[0], n[0], 0), line_fit(order[1], n[1], 0), line_fit(order[2], n[2], 2)}, false);
    } else {
        result.matrix = fit_matrix(mode_matrix(space, points.xi), points.weights);
    }
    result.xi = std::move(points.xi);
    return result;
}

Eigen::MatrixXd bubble_projection(const native::Space& space, const std::array<std::uint32_t, 3>& n) {
    constexpr std::uint32_t first = 2;
    return product({line_fit(space.order[0], n[0], 0, first), line_fit(space.order[1], n[1], 0, first),
                    line_fit(space.order[2], n[2], 0, first)},
                   true);
}

} // namespace elvis
