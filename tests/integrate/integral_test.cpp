// Integrals over volumes and boundaries against closed forms, and against each other by the divergence theorem.
#include "integrated.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace elvis::test {
namespace {

using Domain = IntegralRequest::Domain;

const char* const position = "x*grad(x) + y*grad(y) + z*grad(z)";

TEST_CASE("polynomials over a box of every shape are integrated exactly, and known to be") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron", "mixed");
    const GeneratedVolume box(shape_key(shape) + R"("mesh": "box", "elements": [4, 3, 2], "field": "polynomial",
        "coefficients": [[2, 0, 0, 1], [0, 2, 2, 3], [1, 1, 0, 5], [0, 0, 0, 0.5]])");
    const Integral found = integral_of(box, over(Domain::volume, "polynomial"));
    INFO(shape << ": " << found.value - 28.0 / 3);
    CHECK(std::abs(found.value - 28.0 / 3) < 1e-12);
    CHECK(std::abs(found.measure - 8) < 1e-12);
    CHECK(found.is_exact);
    CHECK(found.is_converged);
    CHECK(found.error < 1e-12);

    // Products and coordinates are polynomials, too: x^2 times the field, over y and z.
    const Integral moment = integral_of(box, over(Domain::volume, "polynomial * x^2"));
    CHECK(moment.is_exact);
    CHECK(std::abs(moment.value - (8.0 / 5 + 3 * (2.0 / 3) * (4.0 / 9) + 0.5 * 8.0 / 3)) < 1e-12);

    const Integral boundary = integral_of(box, over(Domain::boundary, ""));
    CHECK(std::abs(boundary.measure - 24) < 1e-11);
    CHECK(boundary.value == boundary.measure);
    IntegralRequest side = over(Domain::boundary, "polynomial");
    side.groups = {"x+"};
    CHECK(std::abs(integral_of(box, side).value - (4 * 1.5 + 3 * 4.0 / 9)) < 1e-12);
    IntegralRequest flux = over(Domain::boundary, position, true);
    CHECK(std::abs(integral_of(box, flux).value - 24) < 1e-11);
}

TEST_CASE("in bent elements volume and boundary agree by the divergence theorem") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron", "mixed");
    const GeneratedVolume waves(shape_key(shape) +
                                R"("mesh": "waves", "elements": [4, 2, 2], "geometry_order": 3, "amplitude": 0.08,
        "order": 4, "fields": ["taylor-green", {"field": "sphere", "order": 6}])");
    const Integral volume = integral_of(waves, over(Domain::volume, ""));
    const Integral flux = integral_of(waves, over(Domain::boundary, position, true));
    INFO(shape << ": " << flux.value / 3 - volume.value << ", " << flux.error);
    CHECK(volume.is_exact);
    CHECK(flux.is_exact);
    CHECK(std::abs(flux.value / 3 - volume.value) < 1e-12);

    const Integral divergence = integral_of(waves, over(Domain::volume, "exp(x) + div(velocity)"));
    const Integral through = integral_of(waves, over(Domain::boundary, "exp(x)*grad(x) + velocity", true));
    INFO(divergence.value - through.value << ", " << divergence.error << ", " << through.error);
    CHECK(divergence.is_converged);
    CHECK(std::abs(divergence.value - through.value) < 1e-9);
    CHECK(divergence.value > 8);

    const Integral area = integral_of(waves, over(Domain::boundary, ""));
    CHECK(area.is_converged);
    CHECK_FALSE(area.is_exact);
    CHECK(area.measure > 24);
}

TEST_CASE("what is no polynomial is divided until it is right") {
    const GeneratedVolume box(R"("mesh": "box", "elements": 3, "field": "sphere")");
    const double e = std::numbers::e;
    const Integral smooth = integral_of(box, over(Domain::volume, "exp(x + y + z)"));
    INFO(smooth.value - std::pow(e - 1 / e, 3) << ", " << smooth.error);
    CHECK(smooth.is_converged);
    CHECK_FALSE(smooth.is_exact);
    CHECK(std::abs(smooth.value - std::pow(e - 1 / e, 3)) < 1e-10);

    // A kink within elements: 1e-6 is what many divisions reach.
    IntegralRequest kink = over(Domain::volume, "abs(x - 0.1)");
    kink.tolerance = 1e-5;
    const Integral bent = integral_of(box, kink);
    INFO(bent.value - 4 * (0.5 * 1.21 + 0.5 * 0.81) << ", " << bent.error);
    CHECK(bent.is_converged);
    CHECK(std::abs(bent.value - 4 * (0.5 * 1.21 + 0.5 * 0.81)) < 1e-4);
    CHECK(std::abs(bent.value - 4 * (0.5 * 1.21 + 0.5 * 0.81)) < 4 * bent.error);
}

TEST_CASE("the same bits come whatever the threads do, and elements that are inside out are told") {
    const GeneratedVolume ball(
        R"("mesh": "ball", "shape": "mixed", "elements": 2, "geometry_order": 3, "field": "sinc", "order": 5)");
    IntegralRequest request = over(Domain::volume, "sinc * exp(sinc)");
    request.tolerance = 1e-7;
    const Integral one = integral_of(ball, request);
    for (int again = 0; again < 3; ++again) {
        CHECK(integral_of(ball, request).value == one.value);
    }
    CHECK(one.n_inverted == 0);
    CHECK(std::abs(one.measure - 4 * std::numbers::pi / 3) < 0.01);
    const GeneratedVolume twisted(R"("mesh": "twisted-tetrahedron", "field": "sphere")");
    CHECK(integral_of(twisted, over(Domain::volume, "")).n_inverted == 1);
}

} // namespace
} // namespace elvis::test
