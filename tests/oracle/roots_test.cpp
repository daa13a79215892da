// Roots of functions of one variable that lie close to each other.
#include <core/oracle/isosurface/roots.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace elvis::oracle {

TEST_CASE("Two roots beside a third are found, however close they are") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    int n_lost = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        // A pair in one interval between samples, and one root in the next; the last is beyond them.
        const double step = 1.0 / 16, first = step * std::floor(14 * uniform(random));
        const double a = first + step * (0.05 + 0.4 * uniform(random)), b = a + step * (0.01 + 0.4 * uniform(random));
        const double c = first + step * (1.05 + 0.9 * uniform(random));
        const RealFunction function = [=](double s) { return (s - a) * (s - b) * (s - c) * (s - 2); };
        std::vector<double> points, values;
        for (int i = 0; i <= 16; ++i) {
            points.push_back(step * i);
            values.push_back(function(points.back()));
        }
        const std::vector<double> found = find_close_roots(function, 0, points, values).at;
        REQUIRE(found.size() == 3);
        CHECK(std::abs(found[0] - a) < 1e-12);
        CHECK(std::abs(found[1] - b) < 1e-12);
        CHECK(std::abs(found[2] - c) < 1e-12);
        n_lost += find_roots(function, 0, points, values).at.size() < 3 ? 1 : 0;
    }
    // Without the closer look.
    CHECK(n_lost > 1000);
}

} // namespace elvis::oracle
