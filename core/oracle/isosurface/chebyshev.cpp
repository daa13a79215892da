#include "chebyshev.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>

namespace elvis::oracle {
namespace {

struct Table {
    /** From values at the points to coefficients, and from coefficients to values at four times as many. */
    Eigen::MatrixXd to_coefficients, to_dense_values;
};

// cos(pi k / n) with the argument reduced exactly.
double cosine(std::size_t k, std::size_t n) {
    return static_cast<double>(
        std::cos(std::numbers::pi_v<long double> * static_cast<long double>(k % (2 * n)) / static_cast<long double>(n)));
}

Table make_table(std::size_t n) {
    Table table;
    const auto size = static_cast<Eigen::Index>(n) + 1;
    table.to_coefficients.resize(size, size);
    table.to_dense_values.resize(4 * size - 3, size);
    for (Eigen::Index k = 0; k < size; ++k) {
        const auto order = static_cast<std::size_t>(k);
        // T_k(-c) = (-1)^k T_k(c)
        const double sign = order % 2 == 0 ? 1 : -1;
        for (Eigen::Index i = 0; i < size; ++i) {
            const double end = i == 0 || i + 1 == size ? 0.5 : 1;
            const double last = k == 0 || k + 1 == size ? 0.5 : 1;
            table.to_coefficients(k, i) =
                2.0 / static_cast<double>(n) * end * last * sign * cosine(order * static_cast<std::size_t>(i), n);
        }
        for (Eigen::Index i = 0; i < table.to_dense_values.rows(); ++i)
            table.to_dense_values(i, k) = sign * cosine(order * static_cast<std::size_t>(i), 4 * n);
    }
    return table;
}

std::vector<double> make_points(std::size_t n) {
    std::vector<double> points;
    for (std::size_t i = 0; i <= n; ++i)
        points.push_back(-cosine(i, n));
    return points;
}

// What `make` gives for n, made once for all threads.
template <auto make> const auto& made_for(std::size_t n) {
    using Item = decltype(make(n));
    static std::mutex mutex;
    static std::map<std::size_t, Item> items;
    thread_local std::map<std::size_t, const Item*> known;
    const Item*& item = known[n];
    if (item == nullptr) {
        const std::lock_guard lock(mutex);
        const auto found = items.find(n);
        item = found != items.end() ? &found->second : &items.emplace(n, make(n)).first->second;
    }
    return *item;
}

// Scales rows and columns by powers of two until their norms are alike, which leaves the eigenvalues as they are: a small
// leading coefficient makes one row huge, and with it the error of all eigenvalues (B. N. Parlett, C. Reinsch, "Balancing a
// matrix for calculation of eigenvalues and eigenvectors", 1969).
void balance(Eigen::MatrixXd& matrix) {
    bool is_done = false;
    while (!is_done) {
        is_done = true;
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            const double diagonal = std::abs(matrix(i, i));
            const double row = matrix.row(i).lpNorm<1>() - diagonal, column = matrix.col(i).lpNorm<1>() - diagonal;
            if (row == 0 || column == 0)
                continue;
            const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
            if (column * factor + row / factor < 0.95 * (row + column)) {
                matrix.col(i) *= factor;
                matrix.row(i) /= factor;
                is_done = false;
            }
        }
    }
}

Eigen::Map<const Eigen::VectorXd> vector_of(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

} // namespace

std::span<const double> lobatto_points(std::size_t n) { return made_for<make_points>(n); }

ChebyshevSeries::ChebyshevSeries(std::span<const double> values) : m_coefficients(values.size()) {
    Eigen::Map<Eigen::VectorXd>(m_coefficients.data(), static_cast<Eigen::Index>(values.size())).noalias() =
        made_for<make_table>(values.size() - 1).to_coefficients * vector_of(values);
}

double ChebyshevSeries::operator()(double s) const {
    double next = 0, after = 0;
    for (std::size_t k = m_coefficients.size() - 1; k > 0; --k) {
        const double here = m_coefficients[k] + 2 * s * next - after;
        after = next;
        next = here;
    }
    return m_coefficients[0] + s * next - after;
}

// 2 T_k = T'_{k+1} / (k + 1) - T'_{k-1} / (k - 1)
ChebyshevSeries ChebyshevSeries::antiderivative() const {
    const auto c = [this](std::size_t k) { return k < m_coefficients.size() ? m_coefficients[k] : 0; };
    ChebyshevSeries integral;
    integral.m_coefficients.resize(m_coefficients.size() + 1);
    double at_start = 0;
    for (std::size_t k = integral.m_coefficients.size() - 1; k > 0; --k) {
        integral.m_coefficients[k] = ((k == 1 ? 2 : 1) * c(k - 1) - c(k + 1)) / (2 * static_cast<double>(k));
        at_start += (k % 2 == 0 ? 1 : -1) * integral.m_coefficients[k];
    }
    integral.m_coefficients[0] = -at_start;
    return integral;
}

ChebyshevSeries ChebyshevSeries::derivative() const {
    ChebyshevSeries slope;
    slope.m_coefficients.resize(std::max<std::size_t>(degree(), 1));
    double next = 0, after = 0;
    for (std::size_t k = degree(); k > 0; --k) {
        const double here = after + 2 * static_cast<double>(k) * m_coefficients[k];
        slope.m_coefficients[k - 1] = k == 1 ? 0.5 * here : here;
        after = next;
        next = here;
    }
    return slope;
}

double ChebyshevSeries::tail() const {
    return vector_of(m_coefficients).tail(static_cast<Eigen::Index>(degree() / 4)).cwiseAbs().maxCoeff();
}

double ChebyshevSeries::size() const { return vector_of(m_coefficients).cwiseAbs().maxCoeff(); }

std::vector<double> ChebyshevSeries::dense_values() const {
    std::vector<double> values(4 * degree() + 1);
    Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())).noalias() =
        made_for<make_table>(degree()).to_dense_values * vector_of(m_coefficients);
    return values;
}

std::vector<double> ChebyshevSeries::companion_roots(double level) const {
    std::vector<double> c = m_coefficients;
    c[0] -= level;
    // Leading coefficients that are rounding would only add roots far away, at the price of the others' accuracy.
    const double rounding = 2e-14 * vector_of(c).cwiseAbs().maxCoeff();
    while (c.size() > 1 && std::abs(c.back()) <= rounding)
        c.pop_back();
    std::vector<double> roots;
    const auto n = static_cast<Eigen::Index>(c.size()) - 1;
    if (n < 1)
        return roots;
    if (n == 1) {
        roots.push_back(-c[0] / c[1]);
    } else {
        Eigen::MatrixXd colleague = Eigen::MatrixXd::Zero(n, n);
        colleague(0, 1) = 1;
        for (Eigen::Index i = 1; i < n; ++i) {
            colleague(i, i - 1) = 0.5;
            if (i + 1 < n)
                colleague(i, i + 1) = 0.5;
        }
        for (Eigen::Index k = 0; k < n; ++k)
            colleague(n - 1, k) -= 0.5 * c[static_cast<std::size_t>(k)] / c[static_cast<std::size_t>(n)];
        balance(colleague);
        // A double root that rounding of 1e-15 parts leaves the real axis by its square root.
        constexpr double imaginary_rounding = 1e-7;
        for (const std::complex<double>& root : colleague.eigenvalues())
            if (std::abs(root.imag()) <= imaginary_rounding)
                roots.push_back(root.real());
    }
    std::erase_if(roots, [](double root) { return std::abs(root) > 1 + 1e-12; });
    std::sort(roots.begin(), roots.end());
    return roots;
}

} // namespace elvis::oracle
