// Density from opacity, as ParaView and VTK describe it.

#include "fixture.hpp"

#include <core/scene/color/opacity.hpp>

#include <cmath>

using namespace elvis;
using namespace elvis::test;

namespace {

/** VTK's rule as its documentation and source have it: a cubic of Hermite's with both slopes equal. */
double vtk_rule(const OpacityPoint& a, const OpacityPoint& b, double t) {
    double s = t < a.midpoint ? 0.5 * t / a.midpoint : 0.5 + 0.5 * (t - a.midpoint) / (1 - a.midpoint);
    if (a.sharpness > 0.99) {
        return s < 0.5 ? a.opacity : b.opacity;
    }
    if (a.sharpness < 0.01) {
        return (1 - s) * a.opacity + s * b.opacity;
    }
    if (s < 0.5) {
        s = 0.5 * std::pow(s * 2, 1 + 10 * a.sharpness);
    } else if (s > 0.5) {
        s = 1 - 0.5 * std::pow((1 - s) * 2, 1 + 10 * a.sharpness);
    }
    const double s2 = s * s, s3 = s2 * s;
    const double slope = (1 - a.sharpness) * (b.opacity - a.opacity);
    const double value =
        (2 * s3 - 3 * s2 + 1) * a.opacity + (3 * s2 - 2 * s3) * b.opacity + (s3 - 2 * s2 + s) * slope + (s3 - s2) * slope;
    return std::clamp(value, std::min(a.opacity, b.opacity), std::max(a.opacity, b.opacity));
}

double tau(double opacity) { return -std::log(1 - std::min(opacity, 1 - 1e-6)); }

/** How far density is from the curve at most, as a part of the largest. */
double worst(const std::vector<OpacityPoint>& points, double unit_distance) {
    TransferFunction transfer;
    transfer.density = density_from_opacity(points, unit_distance);
    const auto is_less = [](const auto& a, const auto& b) { return a.value < b.value; };
    REQUIRE(std::is_sorted(transfer.density.begin(), transfer.density.end(), is_less));
    double largest = 0, error = 0;
    for (const OpacityPoint& point : points) {
        largest = std::max(largest, tau(point.opacity) / unit_distance);
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0, 1);
    for (std::size_t i = 1; i < points.size(); ++i) {
        for (int sample = 0; sample < 4000; ++sample) {
            // Many near the ends, where curves are steep.
            double t = part(random);
            t = sample % 3 == 0 ? t : sample % 3 == 1 ? std::pow(t, 9) : 1 - std::pow(t, 9);
            const double value = points[i - 1].value + t * (points[i].value - points[i - 1].value);
            // Not where rounding decides on the side of a step.
            if (points[i - 1].sharpness > 0.99 && std::abs(t - points[i - 1].midpoint) < 1e-9) {
                continue;
            }
            // The place that the value has after rounding.
            const double place = (value - points[i - 1].value) / (points[i].value - points[i - 1].value);
            if (place >= 1) {
                continue;
            }
            const double exact = tau(vtk_rule(points[i - 1], points[i], place)) / unit_distance;
            error = std::max(error, std::abs(density_at(transfer, value) - exact));
        }
    }
    return error / largest;
}

} // namespace

TEST_CASE("Opacity over a unit distance becomes a density") {
    CHECK(density_of(0, 1) == 0);
    CHECK(density_of(0.5, 1) == Approx(0.6931471805599453).epsilon(1e-15));
    CHECK(density_of(0.5, 0.1) == Approx(6.931471805599453).epsilon(1e-15));
    CHECK(density_of(1, 1) == Approx(13.815510557964274).epsilon(1e-9));
    CHECK(density_of(1 - 1e-9, 2) == density_of(1, 2));
    // Small ones without cancellation.
    CHECK(density_of(1e-18, 1) == 1e-18);
}

TEST_CASE("Density is within 1e-4 of its largest of the curve, with no more points than it takes") {
    const std::vector<OpacityPoint> ramp = {{-2, 0}, {5, 0.6}};
    CHECK(worst(ramp, 0.25) <= 1.0001e-4);
    // Half as many could not do: the error grows with the square.
    CHECK(worst(ramp, 0.25) > 0.25e-4);
    CHECK(density_from_opacity(ramp, 1).size() <= 37);

    const std::vector<OpacityPoint> to_one = {{0, 0}, {1, 1}, {2, 0.1}, {3, 0.1}};
    CHECK(worst(to_one, 3) <= 1.0001e-4);
    CHECK(density_from_opacity(to_one, 3).size() < 280);

    CHECK(worst({{0, 0.2}, {1e-3, 0.9999999}, {2, 0.99999999}, {3, 0.5}}, 1) <= 1.0001e-4);
    CHECK(worst({{0, 0}, {1, 1e-7}}, 1) <= 1.0001e-4);
    CHECK(density_from_opacity({{0, 0}, {1, 1e-7}}, 1).size() == 2);
    CHECK(density_from_opacity({{0, 0}, {1, 0}}, 1).back().density == 0);
    CHECK(density_from_opacity({{3, 0.5}}, 1).size() == 1);
}

TEST_CASE("Midpoint and sharpness shape the opacity as in VTK") {
    const double sharpnesses[] = {0, 0.005, 0.02, 0.3, 0.5, 0.9, 0.98, 1};
    for (const double sharpness : sharpnesses) {
        for (const double midpoint : {0.5, 0.2, 0.97}) {
            INFO("sharpness " << sharpness << ", midpoint " << midpoint);
            const OpacityPoint from{1, 0.1, midpoint, sharpness}, to{3, 0.8};
            for (int i = 0; i <= 100; ++i) {
                CHECK(opacity_between(from, to, i / 100.0) == Approx(vtk_rule(from, to, i / 100.0)).margin(1e-15));
            }
            if (sharpness <= 0.99) {
                CHECK(opacity_between(from, to, midpoint) == Approx(0.45));
            }
            CHECK(worst({from, to}, 1) <= 1.0001e-4);
            CHECK(worst({{0, 1, midpoint, sharpness}, from, to, {4, 0}}, 1) <= 1.0001e-4);
        }
    }
    // A step: two points at one value.
    const auto step = density_from_opacity({{0, 0, 0.25, 1}, {4, 0.5}}, 1);
    REQUIRE(step.size() == 4);
    CHECK((step[1].value == 1 && step[1].density == 0));
    CHECK((step[2].value == 1 && step[2].density == step[3].density));
}

TEST_CASE("A step between two points of one value stays") {
    const auto density = density_from_opacity({{0, 0.5}, {1, 0.5}, {1, 0}, {2, 0}}, 1);
    REQUIRE(density.size() == 4);
    CHECK(density[1].density == Approx(std::log(2)));
    CHECK(density[2].density == 0);
    CHECK(density[2].value == 1);
}
