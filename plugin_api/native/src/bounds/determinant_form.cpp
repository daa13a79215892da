#include "determinant_form.hpp"

#include "numbers.hpp"

#include <limits>

namespace elvis::native {
namespace {

std::vector<double> binomial_row(std::size_t n) {
    std::vector<double> row(n, 1.0);
    for (std::size_t k = 1; k < n; ++k)
        row[k] = row[k - 1] * static_cast<double>(n - k) / static_cast<double>(k);
    return row;
}

std::vector<double> binomial_products(const Sizes& n) {
    const std::vector<double> outer = binomial_row(n[0]), mid = binomial_row(n[1]), inner = binomial_row(n[2]);
    std::vector<double> result;
    for (const double a : outer)
        for (const double b : mid)
            for (const double c : inner)
                result.push_back(a * b * c);
    return result;
}

/** Places of the coefficients of a form of sizes n in a form of sizes `in`. */
std::vector<std::size_t> places(const Sizes& n, const Sizes& in) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < n[0]; ++i)
        for (std::size_t j = 0; j < n[1]; ++j)
            for (std::size_t k = 0; k < n[2]; ++k)
                result.push_back((i * in[1] + j) * in[2] + k);
    return result;
}

} // namespace

DeterminantForm::DeterminantForm(const std::array<DerivativeForms::Column, 3>& columns) {
    std::size_t n_cross = 1, n_dot = 1; // products that add up to one coefficient, at most
    for (std::size_t place = 0; place < 3; ++place) {
        m_cross_sizes[place] = columns[1].sizes[place] + columns[2].sizes[place] - 1;
        m_sizes[place] = m_cross_sizes[place] + columns[0].sizes[place] - 1;
        n_cross *= std::min(columns[1].sizes[place], columns[2].sizes[place]);
        n_dot *= columns[0].sizes[place];
    }
    for (std::size_t j = 0; j < 3; ++j) {
        m_columns[j].size = product(columns[j].sizes);
        m_columns[j].binomials = binomial_products(columns[j].sizes);
        m_columns[j].in_cross = places(columns[j].sizes, m_cross_sizes);
        m_columns[j].in_result = places(columns[j].sizes, m_sizes);
        m_workspace_size += 3 * m_columns[j].size;
    }
    m_cross.size = product(m_cross_sizes);
    m_cross.in_result = places(m_cross_sizes, m_sizes);
    m_workspace_size += 3 * m_cross.size;
    for (const double value : binomial_products(m_sizes))
        m_scale.push_back(1 / value);

    // Binomials of three columns and the result (exact up to degree 50, else 2 roundings a step of the row; 2 for their
    // products), one product each, and the two sums of products, whose terms are sums of two and three products themselves.
    const std::size_t degree = m_sizes[0] + m_sizes[1] + m_sizes[2];
    const std::size_t n_binomials = *std::max_element(m_sizes.begin(), m_sizes.end()) <= 50 ? 0 : 2 * degree * 2;
    const auto n_roundings = static_cast<double>(n_binomials + 4 * 3 + 4 + n_cross + 2 + n_dot + 3 + 2);
    m_gamma = n_roundings * unit / (1 - n_roundings * unit) * (1 + 100 * unit);
}

double permanent(const std::array<double, 9>& m) {
    return m[0] * (m[4] * m[8] + m[5] * m[7]) + m[1] * (m[3] * m[8] + m[5] * m[6]) + m[2] * (m[3] * m[7] + m[4] * m[6]);
}

double determinant_error(const std::array<double, 9>& magnitudes, const std::array<double, 9>& errors, double gamma) {
    double bound = gamma * permanent(magnitudes);
    for (std::size_t j = 0; j < 9; j += 3) {
        std::array<double, 9> part = magnitudes;
        for (std::size_t i = j; i < j + 3; ++i)
            part[i] = errors[i];
        bound += permanent(part);
    }
    return bound * (1 + 50 * std::numeric_limits<double>::epsilon());
}

} // namespace elvis::native
