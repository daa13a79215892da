#include <core/volume/boundary/face_fit.hpp>
#include <core/volume/element/chebyshev.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/** Three coordinates a point. */
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/** Points that only check. */
constexpr std::size_t n_checks = 12;

double lobatto(int order, int i) { return -std::cos(std::numbers::pi * i / order); }

/** Spread over the face without a pattern that polynomials could share: the golden ratio's additive recurrence (R2). */
std::pair<double, double> check_point(std::size_t k, bool is_triangle) {
    const double g = 1.32471795724474602596;
    double a = std::fmod(0.5 + static_cast<double>(k + 1) / g, 1.0),
           b = std::fmod(0.5 + static_cast<double>(k + 1) / (g * g), 1.0);
    if (is_triangle && a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    return {2 * a - 1, 2 * b - 1};
}

} // namespace

FaceFit::FaceFit(int order) : m_order(order), m_n_points(n_coefficients() + n_checks) {
    for (int j = 0; j <= order; ++j) {
        for (int i = 0; i <= order; ++i) {
            m_points.insert(m_points.end(), {lobatto(order, i), lobatto(order, j)});
        }
    }
    const auto add_checks = [&](std::size_t n_points, bool is_triangle) {
        for (std::size_t k = 0; m_points.size() < 2 * n_points; ++k) {
            const auto [u, v] = check_point(k, is_triangle);
            m_points.insert(m_points.end(), {u, v});
        }
    };
    add_checks(m_n_points, false);
    // M. G. Blyth, C. Pozrikidis, A Lobatto interpolation grid over the triangle, IMA J. Appl. Math. 71 (2006).
    for (int j = 0; j <= order; ++j) {
        for (int i = 0; i + j <= order; ++i) {
            const auto at = [&](int k) { return 0.5 * (1 + lobatto(order, k)); };
            const double vi = at(i), vj = at(j), vk = at(order - i - j);
            m_points.insert(m_points.end(), {2 * (1 + 2 * vi - vj - vk) / 3 - 1, 2 * (1 + 2 * vj - vi - vk) / 3 - 1});
        }
    }
    add_checks(2 * m_n_points, true);
    m_shapes[0] = make_shape(false);
    m_shapes[1] = make_shape(true);
}

FaceFit::Shape FaceFit::make_shape(bool is_triangle) const {
    const auto size = static_cast<std::size_t>(m_order + 1);
    const std::size_t n_coefficients = size * size;
    const std::size_t n = is_triangle ? size * (size + 1) / 2 : n_coefficients;
    const double* points = m_points.data() + (is_triangle ? 2 * m_n_points : 0);
    RowMatrix vandermonde(m_n_points, n);
    std::vector<std::size_t> place;
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t i = 0; i < (is_triangle ? size - j : size); ++i) {
            place.push_back(j * size + i);
        }
    }
    for (std::size_t k = 0; k < m_n_points; ++k) {
        const std::vector<double> tu = chebyshev_values(m_order, points[2 * k]),
                                  tv = chebyshev_values(m_order, points[2 * k + 1]);
        for (std::size_t term = 0; term < n; ++term) {
            vandermonde(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(term)) =
                tu[place[term] % size] * tv[place[term] / size];
        }
    }
    const auto rows = static_cast<Eigen::Index>(n);
    const RowMatrix inverse = vandermonde.topRows(rows).fullPivLu().inverse();
    RowMatrix matrix = RowMatrix::Zero(static_cast<Eigen::Index>(n_coefficients), rows);
    RowMatrix values = RowMatrix::Zero(static_cast<Eigen::Index>(m_n_points), static_cast<Eigen::Index>(n_coefficients));
    for (std::size_t term = 0; term < n; ++term) {
        matrix.row(static_cast<Eigen::Index>(place[term])) = inverse.row(static_cast<Eigen::Index>(term));
        values.col(static_cast<Eigen::Index>(place[term])) = vandermonde.col(static_cast<Eigen::Index>(term));
    }
    return {n, {matrix.data(), matrix.data() + matrix.size()}, {values.data(), values.data() + values.size()}};
}

double FaceFit::fit(bool is_triangle, std::span<const double> positions, std::span<double> coefficients) const {
    const Shape& shape = m_shapes[is_triangle ? 1 : 0];
    const std::size_t n = shape.n_interpolated;
    const auto stride = static_cast<Eigen::Index>(n_coefficients());
    const Eigen::Map<const RowMatrix> matrix(shape.matrix.data(), stride, static_cast<Eigen::Index>(n));
    const Eigen::Map<const RowMatrix> values(shape.values.data(), static_cast<Eigen::Index>(m_n_points), stride);
    const Eigen::Map<const Points> given(positions.data(), static_cast<Eigen::Index>(m_n_points), 3);
    Eigen::Map<Points> fitted(coefficients.data(), stride, 3);
    const auto first = static_cast<Eigen::Index>(n);
    fitted = matrix * given.topRows(first);
    fitted += matrix * (given.topRows(first) - values.topRows(first) * fitted);
    const Eigen::Index n_others = values.rows() - first;
    return (given.bottomRows(n_others) - values.bottomRows(n_others) * fitted).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

} // namespace elvis
