/**
 * @file plot_ticks.hpp
 * Where an axis has its numbers.
 */
#pragma once

#include <vector>

namespace elvis {

/** Positions of an axis's ticks in [lower, upper], ascending: 1, 2 or 5 times a power of ten. */
std::vector<double> plot_ticks(double lower, double upper, bool is_logarithmic);

} // namespace elvis
