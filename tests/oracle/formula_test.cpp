#include <core/oracle/scene/formula.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {

TEST_CASE("Formulas have the values and gradients of what they say") {
    const Vector x(0.3, -1.2, 2.5);
    const auto check = [&](const char* text, double value, const Vector& gradient) {
        INFO(text);
        const std::optional<Formula> formula = parse_formula(text);
        REQUIRE(formula);
        CHECK((*formula)(x).value == Approx(value).epsilon(1e-14));
        CHECK(((*formula)(x).gradient - gradient).norm() < 1e-13);
    };
    check("z - 0.2 * sin(3 * x) * cos(3 * y)", 2.5 - 0.2 * std::sin(0.9) * std::cos(-3.6),
          {-0.6 * std::cos(0.9) * std::cos(-3.6), 0.6 * std::sin(0.9) * std::sin(-3.6), 1});
    check("-x^2 + 2 * (y - -1)^3 - 1e-1", -0.09 + 2 * std::pow(-0.2, 3) - 0.1, {-0.6, 6 * 0.04, 0});
    check("1 - y - z", 1 + 1.2 - 2.5, {0, -1, -1});
    check("exp(x) * -z", -2.5 * std::exp(0.3), {-2.5 * std::exp(0.3), 0, -std::exp(0.3)});
}

TEST_CASE("Formulas that are not smooth, or are none, are not known") {
    for (const char* text : {"", "abs(x)", "x / y", "x ^ 0.5", "x ^ y", "2 x", "(x", "x)", "sqrt(x)", "u", "x +", "x^2^2"})
        CHECK_FALSE(parse_formula(text));
}

} // namespace elvis::oracle
