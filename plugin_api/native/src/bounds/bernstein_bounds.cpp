#include "bernstein_bounds.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace elvis::native::device {
namespace {

using native::Shape;

/** Exponents of l_0 .. l_3. */
using Exponents = std::array<int, 4>;

double binomial(int n, int k) {
    double result = 1;
    for (int i = 1; i <= k; ++i)
        result *= double(n - k + i) / i;
    return result;
}

/** Bernstein coefficients of P_n^{a,0}. */
std::vector<double> jacobi_coefficients(int a, int n) {
    std::vector<double> result;
    for (int i = 0; i <= n; ++i)
        result.push_back(((n - i) % 2 == 0 ? 1 : -1) * binomial(n + a, i));
    return result;
}

/** The same polynomial with a degree higher by `by`: convex combinations, exact but for rounding. */
std::vector<double> raised(std::vector<double> b, int by) {
    for (; by > 0; --by) {
        const std::size_t n = b.size();
        std::vector<double> next(n + 1);
        for (std::size_t i = 0; i <= n; ++i) {
            const double weight = double(i) / double(n);
            next[i] = (i > 0 ? weight * b[i - 1] : 0) + (i < n ? (1 - weight) * b[i] : 0);
        }
        b = std::move(next);
    }
    return b;
}

/** Coefficients of P_n^{a,0} at raised degree, each computed once. */
class RaisedJacobi {
public:
    const std::vector<double>& operator()(int a, int n, int by) {
        const auto [entry, is_new] = m_known.try_emplace({a, n, by});
        if (is_new)
            entry->second = raised(jacobi_coefficients(a, n), by);
        return entry->second;
    }

private:
    std::map<std::array<int, 3>, std::vector<double>> m_known;
};

/** Exponents of degree n in n_corners barycentric coordinates, with their positions. */
std::map<Exponents, std::uint32_t> exponents(int n, int n_corners) {
    std::map<Exponents, std::uint32_t> result;
    const int last = n_corners == 4 ? n : 0;
    for (int k = 0; k <= last; ++k)
        for (int j = 0; j + k <= n; ++j)
            for (int i = 0; i + j + k <= n; ++i)
                result.emplace(Exponents{n - i - j - k, i, j, k}, static_cast<std::uint32_t>(result.size()));
    return result;
}

/** A mode of the triangle or tetrahedron. */
struct Mode {
    int p, q, r;
};

/** Coefficient of degree n of S_p J_q J_r with (q, r) in a tetrahedron; in a triangle q is the second direction and r is 0. */
double coefficient(const Mode& mode, int n, const Exponents& at, RaisedJacobi& jacobi) {
    const auto [l0, i, j, k] = at;
    const auto [p, q, r] = mode;
    if (k > n - p - q || j > n - p - k)
        return 0;
    const double third = jacobi(2 * (p + q) + 2, r, n - p - q - r)[static_cast<std::size_t>(k)];
    const double second = jacobi(2 * p + 1, q, n - p - k - q)[static_cast<std::size_t>(j)];
    const double first = jacobi(0, p, n - k - j - p)[static_cast<std::size_t>(i)];
    return first * second * third * (binomial(n - p - k, j) / binomial(n - k, j)) * (binomial(n - p - q, k) / binomial(n, k));
}

} // namespace

BernsteinBounds::BernsteinBounds(const DeviceSpace& space) {
    std::vector<Mode> modes;
    if (space.shape == Shape::prism) {
        m_n_layers = static_cast<std::size_t>(space.q_max) + 1;
        for (int p = 0; p <= space.p_max; ++p)
            for (int r = 0; r < space.n_r(p, 0); ++r)
                modes.push_back({p, r, 0});
    } else if (space.shape == Shape::tetrahedron) {
        for (int p = 0; p <= space.p_max; ++p)
            for (int q = 0; q < space.n_q(p); ++q)
                for (int r = 0; r < space.n_r(p, q); ++r)
                    modes.push_back({p, q, r});
    } else {
        return;
    }
    for (const Mode& mode : modes)
        m_degree = std::max(m_degree, mode.p + mode.q + mode.r);
    m_n_corners = space.shape == Shape::tetrahedron ? 4 : 3;
    const auto rows = exponents(m_degree, static_cast<int>(m_n_corners));
    m_matrix.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(modes.size()));
    RaisedJacobi jacobi;
    for (const auto& [at, row] : rows)
        for (std::size_t mode = 0; mode < modes.size(); ++mode)
            m_matrix(row, static_cast<Eigen::Index>(mode)) = coefficient(modes[mode], m_degree, at, jacobi);
    for (std::size_t mode = 0; mode < modes.size(); ++mode)
        m_largest.push_back(m_matrix.col(static_cast<Eigen::Index>(mode)).cwiseAbs().maxCoeff());
    find_differences(static_cast<int>(m_n_corners));
}

void BernsteinBounds::find_differences(int n_corners) {
    if (m_degree == 0)
        return;
    const auto positions = exponents(m_degree, n_corners);
    const auto corners = static_cast<std::size_t>(n_corners);
    for (const auto& [at, position] : exponents(m_degree - 1, n_corners)) {
        auto& entry = m_first.emplace_back();
        for (std::size_t a = 0; a < corners; ++a) {
            Exponents raised_at = at;
            ++raised_at[a];
            entry[a] = positions.at(raised_at);
        }
    }
    if (m_degree == 1)
        return;
    for (const auto& [at, position] : exponents(m_degree - 2, n_corners)) {
        auto& entry = m_second.emplace_back();
        for (std::size_t a = 0; a < corners; ++a)
            for (std::size_t b = 0; b < corners; ++b) {
                Exponents raised_at = at;
                ++raised_at[a];
                ++raised_at[b];
                entry[a][b] = positions.at(raised_at);
            }
    }
}

DerivativeBound BernsteinBounds::bound(std::span<const double> coefficients) const {
    assert(is_usable());
    const auto n_modes = static_cast<std::size_t>(m_matrix.cols());
    const auto n_rows = static_cast<std::size_t>(m_matrix.rows());
    assert(coefficients.size() == n_modes * m_n_layers);
    thread_local std::vector<double> b;
    thread_local std::vector<double> slopes, bends;
    b.resize(n_rows);
    // Sums over the layers; with several, slopes are needed by the second derivatives that mix directions, too.
    slopes.assign(m_first.size(), 0);
    bends.assign(m_second.size(), 0);
    const bool has_layers = m_n_layers > 1;
    thread_local std::vector<double> sloped_values, bent_values, sloped_slopes;
    sloped_values.assign(has_layers ? n_rows : 0, 0);
    bent_values.assign(has_layers ? n_rows : 0, 0);
    sloped_slopes.assign(has_layers ? m_first.size() : 0, 0);
    double error = 0;
    const double n = m_degree;
    for (std::size_t layer = 0; layer < m_n_layers; ++layer) {
        const double* modes = coefficients.data() + layer * n_modes;
        Eigen::Map<Eigen::VectorXd>(b.data(), m_matrix.rows()).noalias() =
            m_matrix * Eigen::Map<const Eigen::VectorXd>(modes, m_matrix.cols());
        for (std::size_t mode = 0; mode < n_modes; ++mode)
            error += std::abs(modes[mode]) * m_largest[mode];
        // |T_q'| <= q^2, |T_q''| <= q^2 (q^2 - 1) / 3.
        const double slope_of_layer = double(layer) * double(layer);
        const double bend_of_layer = slope_of_layer * (slope_of_layer - 1) / 3;
        if (has_layers)
            for (std::size_t i = 0; i < n_rows; ++i) {
                sloped_values[i] += slope_of_layer * std::abs(b[i]);
                bent_values[i] += bend_of_layer * std::abs(b[i]);
            }
        // One step along direction a raises l_a by 1/2 and lowers l_0 by as much.
        for (std::size_t i = 0; i < m_first.size(); ++i) {
            double sum = 0;
            for (std::size_t a = 1; a < m_n_corners; ++a)
                sum += std::abs(b[m_first[i][a]] - b[m_first[i][0]]);
            slopes[i] += n / 2 * sum;
            if (has_layers)
                sloped_slopes[i] += n / 2 * slope_of_layer * sum;
        }
        for (std::size_t i = 0; i < m_second.size(); ++i) {
            const auto& at = m_second[i];
            double sum = 0;
            for (std::size_t a = 1; a < m_n_corners; ++a)
                for (std::size_t c = 1; c <= a; ++c)
                    sum += (a == c ? 1 : 2) * std::abs((b[at[a][c]] - b[at[a][0]]) - (b[at[0][c]] - b[at[0][0]]));
            bends[i] += n * (n - 1) / 4 * sum;
        }
    }
    const auto largest = [](const std::vector<double>& numbers) {
        return numbers.empty() ? 0.0 : *std::max_element(numbers.begin(), numbers.end());
    };
    const double value_slope = largest(sloped_values);
    const double slope_slope = largest(sloped_slopes);
    const double value_bend = largest(bent_values);
    // Each coefficient is off by the rounding of the conversion (1e-13, see DerivativeWeights::bound) and of its own sum. A
    // slope takes n/2 times two of them in each direction, a second derivative n^2/4 times four; layers multiply by their
    // slopes.
    const double relative = 1e-13 + 3e-16 * static_cast<double>(n_modes);
    const double q = static_cast<double>(m_n_layers) - 1;
    const double first_error = relative * error * (3 * n + q * q);
    const double second_error = relative * error * (9 * n * n + 6 * n * q * q + q * q * q * q);
    return {largest(slopes) + value_slope + first_error, largest(bends) + 2 * slope_slope + value_bend + second_error};
}

} // namespace elvis::native::device
