/**
 * @file adaptive_sum.hpp
 * A sum over boxes, of which those that are off too much are divided.
 */
#pragma once

#include <core/integrate/element_sums.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace elvis {

/** Relative to the sum of magnitudes: of sums of some thousand rounded terms. */
inline constexpr double sum_rounding = 1e-14;

/** What an integral's error may be at most. */
struct SumTolerance {
    double value = std::numeric_limits<double>::infinity();
    double measure = std::numeric_limits<double>::infinity();
};

/** Of one box, by its rule. */
struct BoxSums {
    Sums sums;
    double value_error = 0, measure_error = 0;
    /** If not, the box has to be divided, and the errors say what is lost where it cannot be. */
    bool is_usable = true;
};

/** Of an element or a face. */
struct PartSums {
    Sums sums;
    double value_error = 0, measure_error = 0;
    std::uint64_t n_unresolved = 0;
};

/**
 * Over the boxes and what they are divided into. A box of depth d counts if its errors are within the tolerance over 2^d; if
 * not, it is divided until it has the largest depth, or there are many.
 */
template <class Box>
PartSums adaptive_sum(std::vector<Box> boxes, const std::function<BoxSums(const Box&)>& rule, const SumTolerance& tolerance,
                      unsigned most_depth) {
    constexpr std::size_t most_boxes = 20000;
    PartSums total;
    for (std::size_t n_boxes = boxes.size(); !boxes.empty();) {
        const Box box = boxes.back();
        boxes.pop_back();
        const BoxSums found = rule(box);
        const double share = 1.0 / static_cast<double>(1u << box.depth);
        const bool is_good = found.is_usable &&
                             found.value_error <= std::max(share * tolerance.value, sum_rounding * found.sums.size) &&
                             found.measure_error <= std::max(share * tolerance.measure, sum_rounding * found.sums.measure);
        if (!is_good && box.depth < most_depth && n_boxes < most_boxes) {
            for (const Box& part : box.divided()) {
                boxes.push_back(part);
                ++n_boxes;
            }
            continue;
        }
        total.sums += found.sums;
        total.value_error += found.value_error;
        total.measure_error += found.measure_error;
        total.n_unresolved += found.is_usable ? 0 : 1;
    }
    return total;
}

} // namespace elvis
