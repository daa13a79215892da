#include "bernstein.hpp"

#include "basis.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

namespace elvis::dubiner {

namespace {

/** How often each of the corners 1, 2, 3 counts; the rest of the order is corner 0's. */
using Exponents = std::array<std::size_t, 3>;

std::vector<Exponents> all_exponents(std::size_t order) {
    std::vector<Exponents> all;
    for (std::size_t k = 0; k <= order; ++k) {
        for (std::size_t j = 0; j + k <= order; ++j) {
            for (std::size_t i = 0; i + j + k <= order; ++i) {
                all.push_back({i, j, k});
            }
        }
    }
    return all;
}

/** Position in all_exponents(). */
std::size_t position(std::size_t order, const Exponents& e) {
    const auto triangle = [](std::size_t n) { return (n + 1) * (n + 2) / 2; };
    std::size_t at = 0;
    for (std::size_t k = 0; k < e[2]; ++k) {
        at += triangle(order - k);
    }
    for (std::size_t j = 0; j < e[1]; ++j) {
        at += order - e[2] - j + 1;
    }
    return at + e[0];
}

double bernstein(std::size_t order, const Exponents& e, const Point& xi) {
    const double corner[] = {-(1 + xi[0] + xi[1] + xi[2]) / 2, (1 + xi[0]) / 2, (1 + xi[1]) / 2, (1 + xi[2]) / 2};
    const std::size_t powers[] = {order - e[0] - e[1] - e[2], e[0], e[1], e[2]};
    double value = std::tgamma(static_cast<double>(order) + 1);
    for (std::size_t i = 0; i < 4; ++i) {
        value *= std::pow(corner[i], static_cast<double>(powers[i])) / std::tgamma(static_cast<double>(powers[i]) + 1);
    }
    return value;
}

/** Bernstein coefficients, one order lower, of the derivative by xi_axis: that corner's barycentric coordinate grows by 1/2. */
Eigen::VectorXd derivative(std::size_t order, const Eigen::VectorXd& b, std::size_t axis) {
    const std::vector<Exponents> lower = all_exponents(order - 1);
    Eigen::VectorXd slope(static_cast<Eigen::Index>(lower.size()));
    for (std::size_t i = 0; i < lower.size(); ++i) {
        Exponents up = lower[i];
        ++up[axis];
        slope[static_cast<Eigen::Index>(i)] =
            0.5 * static_cast<double>(order) *
            (b[static_cast<Eigen::Index>(position(order, up))] - b[static_cast<Eigen::Index>(position(order, lower[i]))]);
    }
    return slope;
}

} // namespace

std::vector<Point> lattice(std::size_t order) {
    if (order == 0) {
        return {{-0.5, -0.5, -0.5}};
    }
    std::vector<Point> points;
    for (const Exponents& e : all_exponents(order)) {
        Point& point = points.emplace_back();
        for (std::size_t d = 0; d < 3; ++d) {
            point[d] = -1 + 2 * static_cast<double>(e[d]) / static_cast<double>(order);
        }
    }
    return points;
}

Eigen::MatrixXd modes_at_lattice(std::size_t order) {
    const std::vector<Point> points = lattice(order);
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd values(n, n);
    std::vector<Mode> modes(points.size());
    for (Eigen::Index i = 0; i < n; ++i) {
        evaluate_modes(order, points[static_cast<std::size_t>(i)], modes);
        for (Eigen::Index mode = 0; mode < n; ++mode) {
            values(i, mode) = modes[static_cast<std::size_t>(mode)].value;
        }
    }
    return values;
}

BernsteinBounds::BernsteinBounds(std::size_t order) : m_order(order) {
    const std::vector<Point> points = lattice(order);
    const std::vector<Exponents> exponents = all_exponents(order);
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd values(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            values(i, j) = bernstein(order, exponents[static_cast<std::size_t>(j)], points[static_cast<std::size_t>(i)]);
        }
    }
    m_from_modes = values.partialPivLu().solve(modes_at_lattice(order));
    m_size = m_from_modes.cwiseAbs().colwise().maxCoeff().transpose();
}

Eigen::VectorXd BernsteinBounds::to_bernstein(std::span<const double> coefficients) const {
    return m_from_modes *
           Eigen::Map<const Eigen::VectorXd>(coefficients.data(), static_cast<Eigen::Index>(coefficients.size()));
}

double BernsteinBounds::rounding(std::span<const double> coefficients) const {
    double sum = 0;
    for (std::size_t mode = 0; mode < coefficients.size(); ++mode) {
        sum += std::abs(coefficients[mode]) * m_size[static_cast<Eigen::Index>(mode)];
    }
    return std::ldexp(sum, -23);
}

Range BernsteinBounds::range(std::span<const double> coefficients) const {
    const Eigen::VectorXd b = to_bernstein(coefficients);
    const double slack = rounding(coefficients);
    return {b.minCoeff() - slack, b.maxCoeff() + slack};
}

Steepness BernsteinBounds::steepness(std::span<const double> coefficients) const {
    Steepness steepness;
    if (m_order == 0) {
        return steepness;
    }
    const Eigen::VectorXd b = to_bernstein(coefficients);
    // A difference of two coefficients of which each is off by the slack, times half of the order; three of them, then nine.
    const double n = static_cast<double>(m_order), slack = n * rounding(coefficients);
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::VectorXd slope = derivative(m_order, b, i);
        steepness.first += slope.cwiseAbs().maxCoeff() + slack;
        for (std::size_t j = 0; j < 3 && m_order > 1; ++j) {
            steepness.second += derivative(m_order - 1, slope, j).cwiseAbs().maxCoeff() + (n - 1) * slack;
        }
    }
    return steepness;
}

} // namespace elvis::dubiner
