/**
 * @file quadric_level.hpp
 * The value of a quadric's polynomial at a point far from the origin.
 */
#pragma once

#include <core/surface/shape.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <cstddef>

namespace elvis {

/**
 * Its terms grow with the square of the point's distance from the origin, and cancel where the surface is near: at a distance
 * of 1e4, extended precision would leave an error of 2e-11, which a ray along the surface magnifies. So they are summed in
 * quadruple precision.
 */
inline long double quadric_level(const Quadric& quadric, const std::array<long double, 3>& at) {
    using Quad = boost::multiprecision::cpp_bin_float_quad;
    const std::array<double, 10>& c = quadric.coefficients;
    const Quad x = at[0], y = at[1], z = at[2];
    const Quad value =
        x * (c[0] * x + c[3] * y + c[5] * z + c[6]) + y * (c[1] * y + c[4] * z + c[7]) + z * (c[2] * z + c[8]) + c[9];
    return value.convert_to<long double>();
}

} // namespace elvis
