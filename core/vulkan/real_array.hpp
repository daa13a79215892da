/**
 * @file real_array.hpp
 * Numbers on their way to and from the device in the precision in use.
 */
#pragma once

#include <core/vulkan/buffer.hpp>

#include <span>
#include <vector>

namespace elvis {

inline std::size_t real_bytes(Precision precision) { return precision == Precision::float64 ? sizeof(double) : sizeof(float); }

/** Calls with a number of the type that the precision stands for. */
template <class Call> decltype(auto) with_real(Precision precision, const Call& call) {
    return precision == Precision::float64 ? call(double{}) : call(float{});
}

/** Writes numbers from the start of a buffer. */
inline void write_reals(const Buffer& buffer, Precision precision, std::span<const double> numbers) {
    if (precision == Precision::float64) {
        buffer.write_items(numbers);
        return;
    }
    const std::vector<float> rounded(numbers.begin(), numbers.end());
    buffer.write_items(std::span<const float>(rounded));
}

/** The first numbers of a buffer. */
inline std::vector<double> read_reals(const Buffer& buffer, Precision precision, std::size_t count) {
    if (precision == Precision::float64) {
        return buffer.read_items<double>(count);
    }
    const std::vector<float> numbers = buffer.read_items<float>(count);
    return {numbers.begin(), numbers.end()};
}

} // namespace elvis
