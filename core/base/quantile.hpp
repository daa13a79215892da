/**
 * @file quantile.hpp
 * Quantiles of a list.
 */
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace elvis {

/** The value below which that part of the values lies, which ascend; `part` in [0, 1]. There is at least one value. */
inline double quantile(std::span<const double> sorted, double part) {
    const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

} // namespace elvis
