// Quadrics far from the origin, against rational arithmetic.

#include <core/surface/quadric_level.hpp>

#include <catch2/catch.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace elvis {

using Rational = boost::multiprecision::cpp_rational;

TEST_CASE("The value of a quadric far from the origin keeps the digits that its coefficients have") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coefficient(-1, 1), place(9999, 10001);
    double worst = 0;
    for (int round = 0; round < 500; ++round) {
        Quadric quadric;
        std::array<double, 10>& c = quadric.coefficients;
        std::generate(c.begin(), c.begin() + 6, [&] { return coefficient(random); });
        const std::array<double, 3> at = {place(random), -place(random), place(random)};
        // About as a surface has them that is about here.
        c[6] = -2 * c[0] * at[0] - c[3] * at[1] - c[5] * at[2];
        c[7] = -2 * c[1] * at[1] - c[3] * at[0] - c[4] * at[2];
        c[8] = -2 * c[2] * at[2] - c[4] * at[1] - c[5] * at[0];
        c[9] = -(c[6] * at[0] + c[7] * at[1] + c[8] * at[2]) / 2 + coefficient(random);
        const Rational x(at[0]), y(at[1]), z(at[2]);
        const Rational value = Rational(c[0]) * x * x + Rational(c[1]) * y * y + Rational(c[2]) * z * z +
                               Rational(c[3]) * x * y + Rational(c[4]) * y * z + Rational(c[5]) * z * x + Rational(c[6]) * x +
                               Rational(c[7]) * y + Rational(c[8]) * z + Rational(c[9]);
        const long double level = quadric_level(quadric, {at[0], at[1], at[2]});
        const Rational off = value - Rational(static_cast<double>(level)) -
                             Rational(static_cast<double>(level - static_cast<long double>(static_cast<double>(level))));
        worst = std::max(worst, std::abs(off.convert_to<double>()));
    }
    std::cout << "level of quadrics 1e4 from the origin: off by at most " << worst << "\n";
    CHECK(worst < 1e-18);
}

} // namespace elvis
