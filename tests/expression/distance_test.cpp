// Distances to surfaces of a scene.
#include <core/base/error.hpp>
#include <core/expression/evaluate.hpp>
#include <core/scene/surface_distance.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace elvis {
namespace {

SceneSurface named(const char* name, SurfaceGeometry geometry) {
    SceneSurface surface{std::move(geometry)};
    surface.name = name;
    return surface;
}

} // namespace

TEST_CASE("Distances to planes, spheres and tori of the scene are what geometry says, with their gradients") {
    const std::vector<SceneSurface> surfaces = {
        named("cut", CutPlane{{3, 0, -4, 10}}), named("ball", CutShape{Sphere{{1, -2, 0.5}, 0.75}}),
        named("ring", CutShape{Torus{{0.5, 0, 1}, {0, 2, 0}, 2, 0.5}}), named("dent", CutShape{Quadric{}})};
    const auto at = [&](const char* text, const std::array<double, 3>& x) {
        return evaluate_implicit(Expression::implicit(with_distances(text, surfaces)), x);
    };
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-3, 3);
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
        const std::array<double, 3> x = {any(random), any(random), any(random)};
        largest = std::max(largest, std::abs(at("distance(cut)", x).value - (0.6 * x[0] - 0.8 * x[2] + 2)));
        largest =
            std::max(largest, std::abs(at("distance(ball)", x).value - (std::hypot(x[0] - 1, x[1] + 2, x[2] - 0.5) - 0.75)));
        const double from_axis = std::hypot(x[0] - 0.5, x[2] - 1);
        const ValueAndGradient ring = at("distance(ring)", x);
        largest = std::max(largest, std::abs(ring.value - (std::hypot(from_axis - 2, x[1]) - 0.5)));
        // The gradient of a distance has length one.
        largest = std::max(largest, std::abs(std::hypot(ring.gradient[0], ring.gradient[1], ring.gradient[2]) - 1));
    }
    WARN("largest error " << largest);
    CHECK(largest < 1e-13);
    CHECK(with_distances("'distance(cut)' + distances(cut)", surfaces) == "'distance(cut)' + distances(cut)");
    CHECK_THROWS_WITH(with_distances("distance(bal)", surfaces), Catch::Contains("'ball'"));
    CHECK_THROWS_WITH(with_distances("distance(dent)", surfaces), Catch::Contains("cylinders and cones"));
}

TEST_CASE("Distances to cylinders and cones are those to their sides, caps and rims, with gradients of length one") {
    // Distance of (r, h) from a segment, by its nearest point.
    const auto to_segment = [](double r, double h, std::array<double, 2> a, std::array<double, 2> b) {
        const double dr = b[0] - a[0], dh = b[1] - a[1];
        const double s = std::clamp(((r - a[0]) * dr + (h - a[1]) * dh) / (dr * dr + dh * dh), 0.0, 1.0);
        return std::hypot(r - a[0] - s * dr, h - a[1] - s * dh);
    };
    struct Case {
        double from_radius, to_radius;
        bool is_capped;
    };
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-3, 3);
    double largest = 0, steepest = 0;
    int n_inside = 0;
    for (const Case& c : {Case{0.8, 0.8, true}, Case{0.8, 0.8, false}, Case{0.5, 1.4, true}, Case{1.4, 0.5, false},
                          Case{0, 1.2, true}, Case{1.2, 0, true}, Case{1.2, 0, false}}) {
        // From (1, 0, -1) along (2, -1, 2) / 3, 2.4 long.
        const std::array<double, 3> axis = {2.0 / 3, -1.0 / 3, 2.0 / 3}, from = {1, 0, -1};
        const std::array<double, 3> to = {1 + 1.6, -0.8, -1 + 1.6};
        const bool is_cylinder = c.from_radius == c.to_radius;
        const CutShape shape = is_cylinder ? CutShape{Cylinder{from, to, c.from_radius, c.is_capped}}
                                           : CutShape{Cone{from, to, c.from_radius, c.to_radius, c.is_capped}};
        const std::vector<SceneSurface> surfaces = {named("it", shape)};
        const Expression distance = Expression::implicit(with_distances("distance(it)", surfaces));
        for (int i = 0; i < 2000; ++i) {
            const std::array<double, 3> x = {any(random) + 1.8, any(random), any(random)};
            const std::array<double, 3> d = {x[0] - from[0], x[1] - from[1], x[2] - from[2]};
            const double h = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
            const double r = std::hypot(d[0] - h * axis[0], d[1] - h * axis[1], d[2] - h * axis[2]);
            double expected = to_segment(r, h, {c.from_radius, 0}, {c.to_radius, 2.4});
            if (c.is_capped) {
                if (c.from_radius > 0)
                    expected = std::min(expected, to_segment(r, h, {0, 0}, {c.from_radius, 0}));
                if (c.to_radius > 0)
                    expected = std::min(expected, to_segment(r, h, {0, 2.4}, {c.to_radius, 2.4}));
                const bool is_inside = h > 0 && h < 2.4 && r < c.from_radius + h / 2.4 * (c.to_radius - c.from_radius);
                n_inside += is_inside ? 1 : 0;
                expected = is_inside ? -expected : expected;
            }
            const ValueAndGradient found = evaluate_implicit(distance, x);
            largest = std::max(largest, std::abs(found.value - expected));
            const double length = std::hypot(found.gradient[0], found.gradient[1], found.gradient[2]);
            steepest = std::max(steepest, std::isnan(length) ? 1.0 : std::abs(length - 1));
        }
        // On a cap, and on the axis, there are numbers.
        const ValueAndGradient on_cap = evaluate_implicit(distance, {1, 0, -1});
        CHECK(std::isfinite(on_cap.value));
        CHECK(std::isfinite(on_cap.gradient[0]));
    }
    WARN("largest error " << largest << ", of the gradient's length " << steepest << "; " << n_inside << " points inside");
    CHECK(largest < 1e-13);
    CHECK(steepest < 1e-10);
    CHECK(n_inside > 100);
}

} // namespace elvis
