// Distances to surfaces of a scene.
#include <core/base/error.hpp>
#include <core/expression/evaluate.hpp>
#include <core/scene/surface_distance.hpp>

#include <catch2/catch.hpp>

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
        named("ring", CutShape{Torus{{0.5, 0, 1}, {0, 2, 0}, 2, 0.5}}), named("tube", CutShape{Cylinder{{0, 0, 0}, {1, 0, 0}, 1, true}})};
    const auto at = [&](const char* text, const std::array<double, 3>& x) {
        return evaluate_implicit(Expression::implicit(with_distances(text, surfaces)), x);
    };
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-3, 3);
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
        const std::array<double, 3> x = {any(random), any(random), any(random)};
        largest = std::max(largest, std::abs(at("distance(cut)", x).value - (0.6 * x[0] - 0.8 * x[2] + 2)));
        largest = std::max(largest, std::abs(at("distance(ball)", x).value - (std::hypot(x[0] - 1, x[1] + 2, x[2] - 0.5) - 0.75)));
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
    CHECK_THROWS_WITH(with_distances("distance(tube)", surfaces), Catch::Contains("planes, spheres and tori"));
}

} // namespace elvis
