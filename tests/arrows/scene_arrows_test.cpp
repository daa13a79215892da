// Where arrows stand, and where they point, beside closed forms.

#include <core/arrows/even_points.hpp>
#include <core/arrows/scene_arrows.hpp>
#include <core/session/streamline_tubes.hpp>
#include <tests/integrate/integrated.hpp>
#include <tests/support/error_of.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::GeneratedVolume;

namespace {

constexpr std::array<double, 6> cube = {-1, -1, -1, 1, 1, 1};

GeneratedVolume ball() {
    return GeneratedVolume(
        R"("mesh": "ball", "shape": "mixed", "elements": [3, 3, 3], "geometry_order": 4, "order": 4, "field": "sphere")");
}

/** The arrows of a scene with these surfaces, the last of which they are. */
std::vector<ArrowSet::Arrow> arrows_of(const GeneratedVolume& volume, const std::string& surfaces,
                                       const std::string& more = "") {
    Scene scene =
        scene_of(nlohmann::json::parse(R"({"version": 1, "surfaces": [)" + surfaces + "]" + more + "}"), "scene.json");
    SceneArrowSets sets;
    const TaskControl control;
    sets.provide(scene, *volume, cube, control);
    const auto& shape = std::get<CutShape>(scene.surfaces.back().geometry);
    const auto& set = std::get<ArrowSurface>(shape).arrows;
    CHECK(scene.surfaces.back().is_shown == !set->arrows.empty());
    return set->arrows;
}

double closest(const std::vector<ArrowSet::Arrow>& arrows) {
    double least = 10;
    for (std::size_t i = 0; i < arrows.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            least = std::min(least, length(minus(arrows[i].from, arrows[j].from)));
        }
    }
    return least;
}

/** How far arrows are from those of a vector field, and their values from those of a function; of the largest. */
double largest_error(const std::vector<ArrowSet::Arrow>& arrows, const std::function<Vector3(const Vector3&)>& along,
                     const std::function<double(const Vector3&)>& value) {
    double largest = 0;
    for (const ArrowSet::Arrow& arrow : arrows) {
        const Vector3 off = minus(minus(arrow.to, arrow.from), along(arrow.from));
        largest = std::max({largest, length(off), std::abs(arrow.value - value(arrow.from))});
    }
    return largest;
}

Vector3 turned(const Vector3& x) { return {0.5 * x[1], 0.5 * x[0], 0}; }
double square(const Vector3& x) { return dot(x, x); }

constexpr const char* wanted =
    R"x({"type": "arrows", "vectors": "grad(x * y)", "spacing": 0.25, "scale": 0.5, "field": "x^2 + y^2 + z^2")x";

} // namespace

TEST_CASE("Arrows in a volume stand on a lattice and have the vectors of the field") {
    const GeneratedVolume volume = ball();
    const auto arrows = arrows_of(volume, std::string(wanted) + "}");
    // Of 9 x 9 x 9 points with steps of 1/4, those in the ball, but for its surface, where rounding decides, and for the axis.
    std::size_t n_inside = 0;
    for (int i = -4; i <= 4; ++i) {
        for (int j = -4; j <= 4; ++j) {
            for (int k = -4; k <= 4; ++k) {
                n_inside += (i != 0 || j != 0) && i * i + j * j + k * k < 16 ? 1 : 0;
            }
        }
    }
    const double error = largest_error(arrows, turned, square);
    std::cout << arrows.size() << " arrows in a ball; largest error " << error << '\n';
    CHECK(arrows.size() >= n_inside);
    CHECK(arrows.size() <= n_inside + 30);
    CHECK(closest(arrows) == Approx(0.25));
    CHECK(error < 1e-9);
}

TEST_CASE("Arrows on a plane stand on a lattice in it") {
    const GeneratedVolume volume = ball();
    const auto arrows = arrows_of(volume, R"({"type": "plane", "name": "cut", "plane": [1, 2, 2, 0.9]}, )" +
                                              std::string(wanted) + R"(, "on": "cut"})");
    double off = 0;
    for (const ArrowSet::Arrow& arrow : arrows) {
        off = std::max(off, std::abs(dot({1, 2, 2}, arrow.from) + 0.9) / 3);
    }
    // A circle of radius^2 1 - 0.3^2.
    const double expected = std::numbers::pi * (1 - 0.09) / (0.25 * 0.25);
    std::cout << arrows.size() << " arrows on a plane, of about " << expected << "; off by " << off << '\n';
    CHECK(std::abs(static_cast<double>(arrows.size()) - expected) < 10);
    CHECK(off < 1e-15);
    CHECK(largest_error(arrows, turned, square) < 1e-9);
    CHECK(closest(arrows) == Approx(0.25));
}

TEST_CASE("Arrows on boundaries and isosurfaces are evenly spaced and lie on them") {
    const GeneratedVolume volume = ball();
    for (const auto& [surface, radius] :
         {std::pair{R"({"type": "boundary", "name": "under"}, )", 1.0},
          std::pair{R"({"type": "isosurface", "name": "under", "field": "x^2 + y^2 + z^2", "values": [0.49]}, )", 0.7}}) {
        const auto arrows = arrows_of(volume, surface + std::string(wanted) + R"(, "on": "under"})");
        double off = 0;
        for (const ArrowSet::Arrow& arrow : arrows) {
            off = std::max(off, std::abs(length(arrow.from) - radius));
        }
        // Discs of half the spacing fill 0.91 of a plane at most, in a lattice of triangles; points at random, added while
        // there is room, 0.55.
        const double filled = static_cast<double>(arrows.size()) * 0.125 * 0.125 / (4 * radius * radius);
        std::cout << arrows.size() << " arrows at radius " << radius << ", off by " << off << "; discs fill " << filled << '\n';
        CHECK(closest(arrows) >= 0.25);
        CHECK(filled > 0.65);
        CHECK(filled < 0.95);
        // The ball's faces are of order 4.
        CHECK(off < (radius == 1.0 ? 1e-3 : 0.25e-9));
        CHECK(largest_error(arrows, turned, square) < 1e-9);
    }
}

TEST_CASE("Arrows stand on shapes of every kind that lie in the volume, and on faces of chosen elements") {
    const GeneratedVolume volume = ball();
    const auto radius = [](const Vector3& x) { return std::hypot(x[0], x[1]); };
    struct Case {
        const char* shape;
        /** How far a point is from it, and its area in the ball. */
        std::function<double(const Vector3&)> off;
        double area;
    };
    const double pi = std::numbers::pi;
    const std::vector<Case> cases = {
        {R"("type": "sphere", "center": [0, 0, 0], "radius": 0.6)", [](const Vector3& x) { return length(x) - 0.6; },
         4 * pi * 0.36},
        {R"("type": "torus", "center": [0, 0, 0], "axis": [0, 0, 1], "major_radius": 0.6, "minor_radius": 0.25)",
         [&](const Vector3& x) { return std::hypot(radius(x) - 0.6, x[2]) - 0.25; }, 4 * pi * pi * 0.6 * 0.25},
        {R"("type": "cylinder", "from": [0, 0, -0.5], "to": [0, 0, 0.5], "radius": 0.5, "capped": false)",
         [&](const Vector3& x) { return std::max(std::abs(radius(x) - 0.5), std::abs(x[2]) - 0.5); }, 2 * pi * 0.5},
        {R"("type": "cone", "from": [0, 0, -0.5], "to": [0, 0, 0.5], "from_radius": 0.6, "to_radius": 0.2)",
         [&](const Vector3& x) {
             const double side = (radius(x) - (0.4 - 0.4 * x[2])) / std::hypot(1, 0.4);
             return std::min({std::abs(side), std::abs(x[2] + 0.5), std::abs(x[2] - 0.5)});
         },
         pi * 0.8 * std::hypot(1, 0.4) + pi * 0.4},
        {R"("type": "quadric", "coefficients": [1, 1, 4, 0, 0, 0, 0, 0, 0, -0.36])",
         [](const Vector3& x) { return x[0] * x[0] + x[1] * x[1] + 4 * x[2] * x[2] - 0.36; }, 2 * 1.38 * pi * 0.36},
        {R"x("type": "implicit", "expression": "z - 0.3 * x")x", [](const Vector3& x) { return x[2] - 0.3 * x[0]; }, pi},
    };
    for (const Case& one : cases) {
        const auto arrows =
            arrows_of(volume, std::string("{") + one.shape + R"(, "name": "under"}, )" + wanted + R"(, "on": "under"})");
        double off = 0;
        for (const ArrowSet::Arrow& arrow : arrows) {
            off = std::max(off, std::abs(one.off(arrow.from)));
        }
        const double filled = static_cast<double>(arrows.size()) * pi * 0.125 * 0.125 / one.area;
        std::cout << arrows.size() << " arrows on " << one.shape << ", off by " << off << "; discs fill " << filled << '\n';
        CHECK(off < 1e-9);
        CHECK(closest(arrows) >= 0.25);
        // A surface with edges has room beyond them.
        CHECK(filled > 0.55);
        CHECK(filled < 1.3);
    }
    const auto chosen = arrows_of(volume, R"({"type": "elements", "ids": [[0, 8]], "faces": "outer", "name": "under"}, )" +
                                              std::string(wanted) + R"(, "on": "under"})");
    CHECK(chosen.size() > 5);
    CHECK(closest(chosen) >= 0.25);
}

TEST_CASE("Arrows stand on triangles of a file where they are in the volume") {
    const GeneratedVolume volume = ball();
    const TemporaryFile file("square.obj");
    std::ofstream(file.path()) << "v -2 -2 0.1\nv 2 -2 0.1\nv 2 2 0.1\nv -2 2 0.1\nf 1 2 3 4\n";
    const auto arrows = arrows_of(volume, R"({"type": "mesh", "file": ")" + file.path() + R"(", "name": "under"}, )" +
                                              std::string(wanted) + R"(, "on": "under"})");
    const bool are_on = std::ranges::all_of(arrows, [](const auto& arrow) { return std::abs(arrow.from[2] - 0.1) < 1e-15; });
    const double filled = static_cast<double>(arrows.size()) * 0.125 * 0.125 / 0.99;
    std::cout << arrows.size() << " arrows on triangles; discs fill " << filled << '\n';
    CHECK(are_on);
    CHECK(closest(arrows) >= 0.25);
    CHECK(filled > 0.7);
}

TEST_CASE("Arrows stand on Bezier patches where they are in the volume") {
    const GeneratedVolume volume = ball();
    const TemporaryFile file("patch.bpt");
    std::ofstream out(file.path());
    // The first two coordinates are linear in u and v, the third one is 0.9 u^2.
    out.precision(17);
    out << "1\n3 3\n";
    for (const auto& [x, height] :
         {std::pair{-1.0, 0.0}, std::pair{-1 / 3.0, 0.0}, std::pair{1 / 3.0, 0.3}, std::pair{1.0, 0.9}}) {
        for (const double y : {-1.0, -1 / 3.0, 1 / 3.0, 1.0}) {
            out << x << ' ' << y << ' ' << height << '\n';
        }
    }
    out.close();
    const auto arrows = arrows_of(volume, R"({"type": "bezier", "file": ")" + file.path() + R"(", "name": "under"}, )" +
                                              std::string(wanted) + R"(, "on": "under"})");
    double off = 0;
    for (const ArrowSet::Arrow& arrow : arrows) {
        const double u = 0.5 + 0.5 * arrow.from[0];
        off = std::max(off, std::abs(arrow.from[2] - 0.9 * u * u));
    }
    std::cout << arrows.size() << " arrows on a Bezier patch, off by " << off << '\n';
    CHECK(arrows.size() > 30);
    CHECK(off < 1e-14);
    CHECK(closest(arrows) >= 0.25);
    CHECK(largest_error(arrows, turned, square) < 1e-9);
}

TEST_CASE("Arrows stand on ribbons along streamlines") {
    const GeneratedVolume volume = ball();
    Scene scene = scene_of(nlohmann::json::parse(R"x({"version": 1, "surfaces": [
        {"type": "streamlines", "flow": "0.4 * grad(x) + y * grad(z) - z * grad(y)", "seeds": [[0, 0, 0]], "ribbon_width": 0.8,
         "name": "under"}, )x" + std::string(wanted) +
                                                 R"(, "spacing": 0.15, "on": "under"}]})"),
                           "scene.json");
    StreamlineTubes ribbons;
    SceneArrowSets sets;
    const TaskControl control;
    ribbons.provide(scene, *volume, cube, control);
    sets.provide(scene, *volume, cube, control);
    const auto& arrows = std::get<ArrowSurface>(std::get<CutShape>(scene.surfaces.back().geometry)).arrows->arrows;
    double off = 0;
    for (const ArrowSet::Arrow& arrow : arrows) {
        const double turn = arrow.from[0] / 0.4;
        off = std::max(off, std::abs(arrow.from[2] * std::cos(turn) - arrow.from[1] * std::sin(turn)));
    }
    std::cout << arrows.size() << " arrows on a helicoid, off by " << off << '\n';
    CHECK(arrows.size() > 30);
    // Pieces turn by three degrees.
    CHECK(off < 1e-3);
    CHECK(closest(arrows) >= 0.15);
    scene.surfaces.front().is_shown = false;
    scene.surfaces.front().geometry = CutShape(RibbonSurface{});
    SceneArrowSets others;
    CHECK_THAT(error_of([&] { others.provide(scene, *volume, cube, control); }), Contains("not drawn"));
}

TEST_CASE("Points on a plane that are chosen evenly are nearly a lattice of triangles") {
    std::vector<Vector3> candidates;
    for (int i = 0; i < 200; ++i) {
        for (int j = 0; j < 200; ++j) {
            candidates.push_back({0.05 * i, 0.05 * j, 0.0});
        }
    }
    const auto chosen = choose_evenly(candidates, 1, [&](std::size_t i) { return candidates[i]; });
    double nearest_sum = 0;
    for (const std::size_t i : chosen) {
        double nearest = 100;
        for (const std::size_t j : chosen) {
            nearest = i == j ? nearest : std::min(nearest, length(minus(candidates[i], candidates[j])));
        }
        CHECK(nearest >= 1);
        nearest_sum += nearest;
    }
    // 10 x 10 with half a cell beyond: 1.1547 points a unit of area in a lattice.
    std::cout << chosen.size() << " points, " << nearest_sum / static_cast<double>(chosen.size()) << " apart on average\n";
    CHECK(chosen.size() > 108);
    CHECK(nearest_sum < 1.05 * static_cast<double>(chosen.size()));
    // None is chosen that cannot be.
    CHECK(choose_evenly(candidates, 1, [](std::size_t) { return std::optional<Vector3>(); }).empty());
}

TEST_CASE("Arrows follow clips and thresholds, and are as long as the spacing at most unless a scale is given") {
    const GeneratedVolume volume = ball();
    const std::string plain = R"x({"type": "arrows", "vectors": "grad(x * y)", "spacing": 0.25, "field": "z")x";
    const auto clipped =
        arrows_of(volume, R"({"type": "plane", "name": "cut", "plane": [0, 0, 1, 0], "clip": [[1, 0, 0, 0.01]]}, )" + plain +
                              R"(, "on": "cut"})");
    const auto left = arrows_of(volume, plain + "}", R"(, "threshold": "x < 0.1 && z >= y")");
    REQUIRE((clipped.size() > 20 && left.size() > 20));
    double longest = 0;
    for (const ArrowSet::Arrow& arrow : clipped) {
        CHECK(arrow.from[0] > -0.011);
        longest = std::max(longest, length(minus(arrow.to, arrow.from)));
    }
    CHECK(longest == Approx(0.25));
    CHECK(std::ranges::all_of(left, [](const auto& arrow) { return arrow.from[0] < 0.1 && arrow.from[2] >= arrow.from[1]; }));
}

TEST_CASE("What arrows cannot show or stand on is told") {
    const GeneratedVolume volume = ball();
    const auto message = [&](const std::string& surfaces) { return error_of([&] { arrows_of(volume, surfaces); }); };
    CHECK_THAT(message(R"({"type": "arrows", "vectors": "x"})"), Contains("x"));
    CHECK_THAT(message(R"x({"type": "arrows", "vectors": "grad(x)", "on": "wall"})x"), Contains("no surface named 'wall'"));
    CHECK_THAT(message(R"x({"type": "wireframe", "name": "s"},
                           {"type": "arrows", "vectors": "grad(x)", "on": "s"})x"),
               Contains("cannot stand on 's'"));
    CHECK_THAT(message(R"x({"type": "arrows", "vectors": "grad(x)", "spacing": 1e-4})x"), Contains("the spacing is too small"));
    CHECK_THAT(message(R"({"type": "arrows"})"), Contains("vectors"));
    CHECK(arrows_of(volume, R"x({"type": "arrows", "vectors": "grad(1 + 0 * x)", "spacing": 0.25})x").empty());
}
