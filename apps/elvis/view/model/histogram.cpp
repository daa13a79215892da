#include "histogram.hpp"

#include <core/base/quantile.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

Histogram::Histogram(double lower, double upper) : m_lower(lower), m_upper(upper), m_bins(n_bins, 0.0f) {}

void Histogram::add(std::span<const double> values) {
    m_sorted.insert(m_sorted.end(), values.begin(), values.end());
    std::sort(m_sorted.begin(), m_sorted.end());
    std::vector<std::size_t> counts(n_bins, 0);
    for (const double value : m_sorted) {
        const double part = m_upper > m_lower ? (value - m_lower) / (m_upper - m_lower) : 0.5;
        const auto bin = static_cast<std::size_t>(std::clamp(part * n_bins, 0.0, n_bins - 1.0));
        ++counts[bin];
    }
    const std::size_t most = std::max<std::size_t>(1, *std::max_element(counts.begin(), counts.end()));
    for (std::size_t bin = 0; bin < n_bins; ++bin) {
        m_bins[bin] = static_cast<float>(counts[bin]) / static_cast<float>(most);
    }
}

double Histogram::quantile(double part) const { return m_sorted.empty() ? m_lower : elvis::quantile(m_sorted, part); }

} // namespace elvis::view
