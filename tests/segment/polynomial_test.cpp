// Bases, tables and the Bernstein form on the CPU.
#include "random.hpp"

#include <catch2/catch.hpp>

#include <iostream>

using namespace elvis;
using namespace elvis::segment;

TEST_CASE("Chebyshev polynomials lose in the Bernstein basis what is known") {
    const std::vector<std::array<double, 2>> known{{6, 46}, {8, 184}, {10, 733}, {12, 2927}};
    for (const auto& [degree, growth] : known) {
        CHECK(std::round(bernstein_growth(static_cast<int>(degree)).back()) == growth);
    }
}

TEMPLATE_TEST_CASE("Bases agree within the stated rounding", "", float, double) {
    test::Random random(1);
    double worst = 0;
    for (int degree = 2; degree <= max_degree; ++degree) {
        for (int trial = 0; trial < 300; ++trial) {
            const auto chebyshev = random.chebyshev<TestType>(degree);
            const Polynomial<TestType> p = to_bernstein(chebyshev);
            const auto rounding = static_cast<double>(bernstein_rounding(chebyshev));
            Polynomial<long double> exact{degree, {}};
            std::copy(chebyshev.c.begin(), chebyshev.c.end(), exact.c.begin());
            const auto level = static_cast<std::uint32_t>(random.between(0, 8));
            const auto place = static_cast<std::uint32_t>(random.between(0, 1u << level));
            const Polynomial<TestType> interval = restricted(p, level, place);
            for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
                const auto x = static_cast<TestType>(s);
                const auto in_interval = (place + static_cast<long double>(x)) / (1u << level);
                const auto error =
                    std::max(std::abs(bernstein_value(p, x) - chebyshev_value(exact, static_cast<long double>(x))),
                             std::abs(bernstein_value(interval, x) - chebyshev_value(exact, in_interval)));
                worst = std::max(worst, static_cast<double>(error) / rounding);
            }
        }
    }
    std::cout << "Bernstein form, " << (sizeof(TestType) == 8 ? "float64" : "float32") << ": largest error " << worst
              << " of the stated rounding\n";
    CHECK(worst < 1);
}

TEST_CASE("Coefficients contain the range, and tighten with subdivision") {
    test::Random random(2);
    double coarse = 0, fine = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Polynomial<double> p = to_bernstein(random.chebyshev<double>(2 + trial % 12));
        const auto widths = [&](std::uint32_t level) {
            double excess = 0;
            for (std::uint32_t place = 0; place < 1u << level; ++place) {
                const Polynomial<double> interval = restricted(p, level, place);
                const auto [least, most] = range(interval);
                double lowest = interval[0], highest = interval[0];
                for (int i = 0; i <= 64; ++i) {
                    const double value = bernstein_value(interval, i / 64.0);
                    REQUIRE(value >= least - 1e-12);
                    REQUIRE(value <= most + 1e-12);
                    lowest = std::min(lowest, value);
                    highest = std::max(highest, value);
                }
                excess = std::max({excess, lowest - least, most - highest});
            }
            return excess;
        };
        coarse += widths(3);
        fine += widths(5);
    }
    // A quarter at each level; linear convergence would give half.
    CHECK(fine < coarse / 12);
}

TEST_CASE("Changes of sign are counted without zeros") {
    const Polynomial<double> p{4, {1, 0, -1, 0, 2}};
    CHECK(variations(p, 0.0) == 2);
    CHECK(variations(p, 1.5) == 1);
    CHECK(variations(p, 3.0) == 0);
    CHECK_FALSE(is_monotone(p));
    CHECK(is_monotone(Polynomial<double>{3, {0, 1, 1, 2}}));
    CHECK(is_monotone(Polynomial<double>{2, {1, 1, 1}}));
}
