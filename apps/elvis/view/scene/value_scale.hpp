/**
 * @file value_scale.hpp
 * Where values lie between the ends of a colour map.
 */
#pragma once

#include <array>
#include <cmath>

namespace elvis::view {

/** A logarithmic one begins above 0. */
class ValueScale {
public:
    ValueScale(const std::array<double, 2>& range, bool is_logarithmic)
        : m_lower(is_logarithmic ? std::log(range[0]) : range[0]), m_upper(is_logarithmic ? std::log(range[1]) : range[1]),
          m_is_logarithmic(is_logarithmic) {}

    /** 0 and 1 at the ends; less than 0 for what a logarithmic scale does not have. */
    double position(double value) const {
        if (m_is_logarithmic && !(value > 0)) {
            return -1;
        }
        return ((m_is_logarithmic ? std::log(value) : value) - m_lower) / (m_upper - m_lower);
    }
    double value(double position) const {
        const double place = m_lower + position * (m_upper - m_lower);
        return m_is_logarithmic ? std::exp(place) : place;
    }

private:
    double m_lower, m_upper;
    bool m_is_logarithmic;
};

} // namespace elvis::view
