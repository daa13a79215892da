/**
 * @file numbers.hpp
 * Numbers of a file.
 */
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace elvis_vtk {

/** Numbers of any type as doubles. */
struct Numbers {
    std::vector<double> values;
    /** Significant bits: 53, 24 for Float32, fewer for text of few digits; 53 for integers. */
    std::uint32_t mantissa_bits = 53;
};

/** Puts numbers behind others. */
inline void append(std::vector<double>& to, std::vector<double>&& from) {
    if (to.empty()) {
        to = std::move(from);
    } else {
        to.insert(to.end(), from.begin(), from.end());
    }
}

} // namespace elvis_vtk
