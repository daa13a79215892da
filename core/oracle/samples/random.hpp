/**
 * @file random.hpp
 * Numbers by chance.
 */
#pragma once

#include <core/oracle/element/reference_shape.hpp>

#include <cstdint>
#include <random>

namespace elvis::oracle {

/** The same numbers with every standard library. */
class Random {
public:
    explicit Random(std::uint64_t seed) : m_engine(seed) {}

    double between(double low, double high) { return low + (high - low) * (static_cast<double>(m_engine() >> 11) * 0x1p-53); }
    int whole(int low, int high) { return low + static_cast<int>(m_engine() % static_cast<std::uint64_t>(high - low + 1)); }
    bool one_in(int n) { return whole(1, n) == 1; }
    Vector in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
    Vector direction() {
        for (;;) {
            const Vector v = in_cube();
            if (v.norm() > 0.1 && v.norm() <= 1)
                return v.normalized();
        }
    }

private:
    std::mt19937_64 m_engine;
};

} // namespace elvis::oracle
