/**
 * @file closed_forms.hpp
 * What the files of the tests hold: functions of reference coordinates and of positions.
 */
#pragma once

#include <array>
#include <cmath>

namespace cgns_test {

using Point = std::array<double, 3>;

/** A polynomial of a degree, of size about 1 in reference elements. */
inline double polynomial(int degree, const Point& x, double shift) {
    return std::pow(0.31 * x[0] - 0.22 * x[1] + 0.17 * x[2] + shift, degree);
}

/** A bent element, beside others by so much; flat ones stay in the plane. */
inline Point bent(int degree, int dimension, const Point& x, double place) {
    const double bend = 0.2 * polynomial(degree, x, 0.9);
    return {4 * place + x[0] + bend, x[1] - 0.7 * bend, dimension == 3 ? x[2] + 0.4 * bend : 0};
}

/** Values of a field in an element. */
inline double value(int degree, const Point& x) { return polynomial(degree, x, 0.6) + x[0]; }

/** The boxes of the other files: linear functions that trilinear cells have exactly. */
inline double pressure(const Point& x) { return 1 + 2 * x[0] - x[1] + 0.5 * x[2]; }
inline Point velocity(const Point& x, double time) { return {x[1] + time, 2 * x[0] - time, x[2] + 3}; }

} // namespace cgns_test
