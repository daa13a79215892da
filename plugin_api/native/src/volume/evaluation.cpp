/*
 * Evaluation on the CPU, from the modes of the native spaces.
 *
 * Fields with a transform, with J_ij = dx_i/dxi_j and its derivative K = dJ/dxi_k:
 *   covariant       u = J^-T uhat          du/dxi_k = J^-T (duhat/dxi_k - K^T u)
 *   contravariant   u = J uhat / det J     du/dxi_k = (K uhat + J duhat/dxi_k) / det J - u tr(J^-1 K)
 * In two dimensions J is that of the first two coordinates; its third column is (0, 0, 1) and uhat's third component 0.
 */
#include "../basis/evaluate.hpp"
#include "volume.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace elvis::native_plugin {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;
using native::Point;

/** Two or three functions, at one point at a time. A third that is missing is 0. */
class VectorFunction {
public:
    VectorFunction(const native::Space& space, std::span<const double> coefficients)
        : m_space(space), m_coefficients(coefficients), m_n_components(coefficients.size() / native::n_modes(space)) {}

    void move_to(const Point& xi) {
        native::evaluate_together(m_space, m_coefficients, xi, std::span(m_value.data(), m_n_components),
                                  std::span(m_derivatives.data(), 3 * m_n_components));
    }
    const Vector3& value() const { return m_value; }
    /** Entry (i, j) = derivative of component i in direction j. */
    const Matrix3& derivatives() const { return m_derivatives; }

private:
    native::Space m_space;
    std::span<const double> m_coefficients;
    std::size_t m_n_components;
    Vector3 m_value = Vector3::Zero();
    Matrix3 m_derivatives = Matrix3::Zero();
};

/**
 * Derivative of the Jacobian J in direction `line`, from the polynomial that interpolates J at Chebyshev points within `reach`
 * times `line` of xi. J must be a polynomial of no more than `degree` on this line; then nothing but round-off is lost.
 */
Matrix3 derivative_along(VectorFunction& mapping, const Point& xi, const Vector3& line, double reach, std::uint32_t degree) {
    // Chebyshev-Gauss points z_i = cos(theta_i); coefficients c_m = 2/n sum_i J(z_i) cos(m theta_i); T_m'(0) = m sin(m pi/2).
    const auto n = static_cast<int>(degree) + 1;
    Matrix3 result = Matrix3::Zero();
    for (int i = 0; i < n; ++i) {
        const double theta = std::numbers::pi * (i + 0.5) / n;
        double weight = 0;
        for (int m = 1; m < n; m += 2)
            weight += 2.0 / n * std::cos(m * theta) * m * (m % 4 == 1 ? 1 : -1);
        const double z = reach * std::cos(theta);
        mapping.move_to({xi[0] + z * line[0], xi[1] + z * line[1], xi[2] + z * line[2]});
        result += weight / reach * mapping.derivatives();
    }
    return result;
}

/**
 * dJ/dxi_k for all k. In all shapes but pyramids J is a polynomial on every line. In pyramids it is one on lines of
 * constant xi3, and on lines through the apex, where the collapsed coordinates eta1 and eta2 are constant:
 * d/dxi3 = d/dline + (1 + eta1)/2 d/dxi1 + (1 + eta2)/2 d/dxi2.
 */
std::array<Matrix3, 3> jacobian_derivatives(VectorFunction& mapping, const native::Space& space, const Point& xi) {
    const std::array<std::uint32_t, 3> orders = native::collapsed_order(space);
    const std::uint32_t degree = std::max({orders[0], orders[1], orders[2]});
    if (space.shape != native::Shape::pyramid)
        return {derivative_along(mapping, xi, Vector3::UnitX(), 1, degree),
                derivative_along(mapping, xi, Vector3::UnitY(), 1, degree),
                derivative_along(mapping, xi, Vector3::UnitZ(), 1, degree)};
    // At the apex itself there is no derivative; close to it round-off grows with 1/t.
    const double t = std::max((1 - xi[2]) / 2, 1e-12);
    const double drift1 = (1 + xi[0]) / (2 * t);
    const double drift2 = (1 + xi[1]) / (2 * t);
    const Matrix3 first = derivative_along(mapping, xi, Vector3::UnitX(), t, degree);
    const Matrix3 second = derivative_along(mapping, xi, Vector3::UnitY(), t, degree);
    const Matrix3 along = derivative_along(mapping, xi, {-drift1, -drift2, 1}, t, degree);
    return {first, second, along + drift1 * first + drift2 * second};
}

Point point(std::span<const double> xi, std::size_t i) { return {xi[3 * i], xi[3 * i + 1], xi[3 * i + 2]}; }

} // namespace

void Volume::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                              std::span<double> jacobians) const {
    const Place where = place(element);
    const Coefficients coefficients = element_geometry(where);
    const native::Space& space = geometry_space(where.element_class);
    const std::size_t n_points = xi.size() / 3;
    if (jacobians.empty() && !positions.empty() && n_points >= ModeTables::least_points) {
        const ModeTables::Table table = m_mode_tables.get(space, xi);
        const Eigen::Map<const Eigen::MatrixX3d> of_modes(coefficients.numbers.data(), table->cols(), 3);
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(positions.data(), table->rows(), 3).noalias() =
            *table * of_modes;
        return;
    }
    VectorFunction mapping(space, coefficients.numbers);
    for (std::size_t i = 0; i < n_points; ++i) {
        mapping.move_to(point(xi, i));
        if (!positions.empty())
            Eigen::Map<Vector3>(positions.data() + 3 * i) = mapping.value();
        if (!jacobians.empty())
            Eigen::Map<Matrix3>(jacobians.data() + 9 * i) = mapping.derivatives();
    }
}

void Volume::evaluate_field(std::size_t field, std::size_t time_step, std::uint64_t element, std::span<const double> xi,
                            std::span<double> values, std::span<double> gradients) const {
    const Place where = place(element);
    const Coefficients coefficients = element_field(field, time_step, where);
    const native::Space& space = field_space(where.element_class, field);
    const native::Transform transform = description().fields[field].transform;
    if (transform == native::Transform::none) {
        const std::size_t n_components = description().fields[field].n_components;
        std::vector<double> unwanted(values.empty() ? n_components : 0);
        for (std::size_t i = 0; i < xi.size() / 3; ++i) {
            native::evaluate_together(space, coefficients.numbers, point(xi, i),
                                      values.empty() ? std::span(unwanted) : values.subspan(i * n_components, n_components),
                                      gradients.empty() ? gradients
                                                        : gradients.subspan(3 * i * n_components, 3 * n_components));
        }
        return;
    }

    const bool covariant = transform == native::Transform::covariant;
    const Coefficients geometry = element_geometry(where);
    const native::Space& mapping_space = geometry_space(where.element_class);
    VectorFunction mapping(mapping_space, geometry.numbers);
    VectorFunction reference(space, coefficients.numbers);
    const auto n_components = static_cast<Eigen::Index>(description().fields[field].n_components);
    for (std::size_t i = 0; i < xi.size() / 3; ++i) {
        const Point at = point(xi, i);
        mapping.move_to(at);
        reference.move_to(at);
        Matrix3 jacobian = mapping.derivatives();
        if (n_components == 2)
            jacobian.col(2) = Vector3::UnitZ();
        const Matrix3 inverse = jacobian.inverse();
        const double determinant = jacobian.determinant();
        const Vector3 hat = reference.value();
        const Vector3 u = covariant ? Vector3(inverse.transpose() * hat) : Vector3(jacobian * hat / determinant);
        if (!values.empty())
            std::copy_n(u.data(), n_components, values.data() + static_cast<std::size_t>(n_components) * i);
        if (gradients.empty())
            continue;
        const Matrix3 hat_derivatives = reference.derivatives();
        Matrix3 gradient;
        const std::array<Matrix3, 3> bends = jacobian_derivatives(mapping, mapping_space, at);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto column = static_cast<Eigen::Index>(k);
            const Matrix3& bend = bends[k];
            if (covariant)
                gradient.col(column) = inverse.transpose() * (hat_derivatives.col(column) - bend.transpose() * u);
            else
                gradient.col(column) =
                    (bend * hat + jacobian * hat_derivatives.col(column)) / determinant - u * (inverse * bend).trace();
        }
        const auto n_numbers = static_cast<std::size_t>(3 * n_components);
        std::copy_n(gradient.data(), n_numbers, gradients.data() + n_numbers * i);
    }
}

} // namespace elvis::native_plugin
