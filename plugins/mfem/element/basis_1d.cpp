#include "basis_1d.hpp"

#include <algorithm>
#include <cmath>

namespace elvis_mfem {

Basis1d::Basis1d(Basis basis, int n) : m_is_bernstein(basis == Basis::positive), m_points(points(basis, n)) {
    m_weights.assign(m_points.size(), 1);
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        for (std::size_t j = 0; j < m_points.size(); ++j) {
            if (i != j) {
                m_weights[i] /= m_points[i] - m_points[j];
            }
        }
    }
}

std::size_t Basis1d::nearest(double x) const {
    const auto distance = [&](double point) { return std::abs(point - x); };
    return static_cast<std::size_t>(std::ranges::min_element(m_points, {}, distance) - m_points.begin());
}

void Basis1d::evaluate(double x, double* values) const {
    const std::size_t n = m_points.size();
    std::fill_n(values, n, 0.0);
    if (m_is_bernstein) {
        // De Casteljau's triangle of basis functions: degree by degree.
        values[0] = 1;
        for (std::size_t degree = 1; degree < n; ++degree) {
            for (std::size_t i = degree; i > 0; --i) {
                values[i] = (1 - x) * values[i] + x * values[i - 1];
            }
            values[0] *= 1 - x;
        }
        return;
    }
    // Second barycentric formula (Berrut, Trefethen 2004).
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (x == m_points[i]) {
            std::fill_n(values, n, 0.0);
            values[i] = 1;
            return;
        }
        values[i] = m_weights[i] / (x - m_points[i]);
        sum += values[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
        values[i] /= sum;
    }
}

} // namespace elvis_mfem
