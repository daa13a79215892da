/**
 * @file random.hpp
 * Deterministic random numbers.
 */
#pragma once

#include <cstdint>
#include <string>

namespace elvis::conformance {

/** splitmix64 (Steele, Lea, Flood 2014): the same numbers on every machine. */
class Random {
public:
    explicit Random(std::uint64_t seed) : m_state(seed) {}
    std::uint64_t next();
    /** 0 .. n-1 (n > 0); the bias of the remainder is of no matter here. */
    std::uint64_t below(std::uint64_t n) { return next() % n; }
    double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t m_state;
};

std::string random_bytes(std::size_t count, std::uint64_t seed);

} // namespace elvis::conformance
