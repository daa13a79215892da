/**
 * @file histogram.hpp
 * How often a field takes its values.
 */
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace elvis::view {

/** Of values at points spread evenly over the volume, so that each counts by the space it takes. */
class Histogram {
public:
    static constexpr std::size_t n_bins = 96;

    Histogram(double lower, double upper);

    void add(std::span<const double> values);

    double lower() const { return m_lower; }
    double upper() const { return m_upper; }
    std::size_t n_values() const { return m_sorted.size(); }
    /** Fractions of the largest bin, in [0, 1]. */
    const std::vector<float>& bins() const { return m_bins; }
    /** The value below which that part of the values lies; `part` in [0, 1]. The lower end if there are no values. */
    double quantile(double part) const;

private:
    double m_lower, m_upper;
    std::vector<double> m_sorted;
    std::vector<float> m_bins;
};

} // namespace elvis::view
