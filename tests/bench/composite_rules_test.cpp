// Composite quadrature: the orders that theory gives for smooth functions, and for functions with a breakpoint.
#include <core/bench/volume/composite_rules.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;

namespace {

std::vector<std::size_t> doublings(std::size_t from, std::size_t to) {
    std::vector<std::size_t> numbers;
    for (std::size_t n = from; n <= to; n *= 2) {
        numbers.push_back(n);
    }
    return numbers;
}

} // namespace

TEST_CASE("the cubics meet at the breakpoint") {
    CHECK(BrokenCubic::value(0.54) == Approx(1).margin(1e-15));
    CHECK(BrokenCubic::value(std::nextafter(0.54, 1)) == Approx(1).margin(1e-15));
    CHECK((BrokenCubic::value(0.54) - BrokenCubic::value(0.53999)) / 1e-5 == Approx(1.5704).margin(1e-4));
    CHECK((BrokenCubic::value(0.54001) - BrokenCubic::value(0.54)) / 1e-5 == Approx(-1.5704).margin(1e-4));
    for (const double t : {0.2, 0.54, 0.7, 1.0}) {
        CAPTURE(t);
        CHECK((BrokenCubic::integral(t) - BrokenCubic::integral(t - 1e-4)) / 1e-4 ==
              Approx(BrokenCubic::value(t - 0.5e-4)).margin(1e-8));
    }
}

TEST_CASE("samples are counted") {
    std::size_t n_calls = 0;
    const auto one = [&n_calls](double) {
        ++n_calls;
        return 1.0;
    };
    for (const CompositeRule rule : composite_rules) {
        CAPTURE(name_of(rule));
        n_calls = 0;
        CHECK(integrate(rule, one, 2, 5, 8) == Approx(3).epsilon(1e-14));
        // Ends that neighbours share are evaluated twice.
        const bool shares = rule == CompositeRule::trapezoid || rule == CompositeRule::simpson;
        CHECK(samples_of(rule, 8) == n_calls - (shares ? 7 : 0));
    }
}

TEST_CASE("every rule has its own order where the function is smooth") {
    // sin: derivatives of all orders are alike. Kronrod's order shows where few intervals hold many waves.
    for (const CompositeRule rule : composite_rules) {
        const bool is_kronrod = rule == CompositeRule::gauss_kronrod;
        const double rate = is_kronrod ? 60 : 2;
        const RealFunction wave = [rate](double t) { return std::sin(rate * t); };
        const double integral = (1 - std::cos(rate)) / rate;
        std::vector<std::size_t> numbers = doublings(8, rule == CompositeRule::gauss_legendre ? 64 : 1024);
        if (is_kronrod) {
            numbers = {3, 4, 5};
        }
        const double order = measured_order(rule_errors(rule, wave, 0, 1, integral, numbers));
        WARN(name_of(rule) << ": order " << order << " for a smooth function");
        CHECK(order == Approx(order_of(rule)).epsilon(is_kronrod ? 0.1 : 0.02));
    }
}

TEST_CASE("every rule is exact for polynomials below its order") {
    for (const CompositeRule rule : composite_rules) {
        for (int degree = 0; degree <= order_of(rule); ++degree) {
            // The Chebyshev polynomial, on an interval without its symmetry, which would let odd degrees pass.
            const RealFunction polynomial = [degree](double t) { return std::cos(degree * std::acos(t)); };
            const auto antiderivative = [degree](double t) {
                const double n = degree, angle = std::acos(t);
                return degree == 0   ? t
                       : degree == 1 ? 0.5 * t * t
                                     : 0.5 * (std::cos((n + 1) * angle) / (n + 1) - std::cos((n - 1) * angle) / (n - 1));
            };
            const double error = std::abs(integrate(rule, polynomial, -1, 0.9, 1) - (antiderivative(0.9) - antiderivative(-1)));
            CAPTURE(name_of(rule), degree, error);
            CHECK((error < 1e-13) == (degree < order_of(rule)));
        }
    }
}

TEST_CASE("rules of higher order are exact on either side of the breakpoint") {
    for (const CompositeRule rule : {CompositeRule::simpson, CompositeRule::gauss_legendre, CompositeRule::gauss_kronrod}) {
        CAPTURE(name_of(rule));
        CHECK(std::abs(integrate(rule, BrokenCubic::value, 0, 0.54, 1) - BrokenCubic::integral(0.54)) < 1e-15);
        const auto after = [](double t) { return BrokenCubic::value(std::max(t, std::nextafter(0.54, 1))); };
        CHECK(std::abs(integrate(rule, after, 0.54, 1, 1) - (BrokenCubic::integral(1) - BrokenCubic::integral(0.54))) < 1e-15);
    }
    // The others keep the orders that they have.
    for (const CompositeRule rule : {CompositeRule::riemann, CompositeRule::midpoint, CompositeRule::trapezoid}) {
        const double order =
            measured_order(rule_errors(rule, BrokenCubic::value, 0, 0.54, BrokenCubic::integral(0.54), doublings(8, 1024)));
        CAPTURE(name_of(rule));
        CHECK(order == Approx(order_of(rule)).epsilon(0.02));
    }
}

TEST_CASE("a breakpoint leaves all rules but Riemann's at second order") {
    std::vector<std::size_t> numbers;
    for (std::size_t n = 16; n <= 4096; n = n + std::max<std::size_t>(1, n / 32)) {
        numbers.push_back(n);
    }
    for (const CompositeRule rule : composite_rules) {
        const std::vector<RuleError> errors = rule_errors(rule, BrokenCubic::value, 0, 1, BrokenCubic::integral(1), numbers);
        // Twelve numbers of intervals, and the breakpoint has been nearly everywhere in its interval.
        const double order = measured_order(errors, 1e-13, 12);
        WARN(name_of(rule) << ": order " << order << ", error " << errors.back().error << " with " << errors.back().n_samples
                           << " samples");
        CHECK(order == Approx(rule == CompositeRule::riemann ? 1 : 2).margin(0.05));
    }
}
