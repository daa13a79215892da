/**
 * @file ticks.hpp
 * Round numbers in a range, and how to write them.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis {

struct Tick {
    /** The double nearest to the round number; inside the range. */
    double value = 0;
    /** (value - offset) / 10^exponent, with as many decimals as all labels of the axis need. Empty: only a short line. */
    std::string label;
};

struct Ticks {
    /** Ascending. */
    std::vector<Tick> ticks;
    int exponent = 0;
    double offset = 0;
    /** What stands beside the axis, as "×10⁻³" or "+ 101325"; empty if labels are the values. */
    std::string scale;
};

/**
 * At most `most` (>= 2) round numbers (1, 2 or 5 times a power of ten, times an integer) from low to high, both included.
 * Values that need more than five digits to be told apart are written as differences from a round number; very large and small
 * ones as multiples of a power of ten. A range without extent, or of numbers that are not finite, gives one tick or none.
 */
Ticks round_ticks(double low, double high, int most);

/**
 * On a logarithmic scale from low to high, above 0: at most `most` powers of ten with a label, and where there is room for it
 * the multiples between them, without. Less than two powers: 1, 2 and 5 times those; less than two of these: as round_ticks().
 */
Ticks logarithmic_ticks(double low, double high, int most);

} // namespace elvis
