// Streamlines of flows with closed forms, in bent elements of every shape.

#include <core/streamline/trace.hpp>
#include <tests/integrate/integrated.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

using namespace elvis;
using test::GeneratedVolume;

namespace {

constexpr const char* shapes[] = {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};

GeneratedVolume bent_box(const std::string& shape) {
    return GeneratedVolume(test::shape_key(shape) + R"("mesh": "waves", "elements": [4, 4, 4], "geometry_order": 2,
                                                       "amplitude": 0.05, "order": 4, "field": "sphere")");
}

Streamline line_of(const GeneratedVolume& volume, const std::string& flow, const Vector3& seed, const TraceOptions& options) {
    const TaskControl control;
    return trace(Flow(*volume, flow, 0), std::span(&seed, 1), options, control).front();
}

/** By the classical method in world coordinates, in steps so short that their error does not count. */
Vector3 reference(const std::function<Vector3(const Vector3&)>& velocity, Vector3 x, double time) {
    constexpr int n_steps = 20000;
    const double h = time / n_steps;
    for (int step = 0; step < n_steps; ++step) {
        const Vector3 a = velocity(x), b = velocity(plus(x, scaled(a, 0.5 * h))), c = velocity(plus(x, scaled(b, 0.5 * h))),
                      d = velocity(plus(x, scaled(c, h)));
        x = plus(x, scaled(plus(plus(a, d), scaled(plus(b, c), 2)), h / 6));
    }
    return x;
}

} // namespace

TEST_CASE("A rigid rotation closes its circles") {
    for (const char* const shape : shapes) {
        const GeneratedVolume volume = bent_box(shape);
        TraceOptions options;
        options.direction = TraceDirection::forward;
        options.tolerance = 1e-12;
        const Vector3 seed{0.62, 0.03, 0.11};
        const double radius = std::hypot(seed[0], seed[1]);
        options.most_length = 2 * std::numbers::pi * radius;
        const Streamline line = line_of(volume, "x * grad(y) - y * grad(x)", seed, options);
        REQUIRE(line.end == TraceEnd::length);
        double off = 0;
        for (const TracePoint& point : line.points) {
            off = std::max({off, std::abs(std::hypot(point.position[0], point.position[1]) - radius),
                            std::abs(point.position[2] - seed[2])});
        }
        const double gap = length(minus(line.points.back().position, seed));
        std::cout << shape << ": closes to " << gap << ", off the circle by " << off << '\n';
        CHECK(gap < 1e-10);
        // Points between steps lie on cubic curves.
        CHECK(off < 1e-6);
        CHECK(line.points.back().time == Approx(2 * std::numbers::pi).epsilon(1e-9));
        CHECK(line.points.back().arc_length == Approx(options.most_length).epsilon(1e-12));
    }
}

TEST_CASE("The ABC flow is followed through elements of every shape") {
    const auto abc = [](const Vector3& x) {
        return Vector3{std::sin(3 * x[2]) + 0.6 * std::cos(3 * x[1]), 0.8 * std::sin(3 * x[0]) + std::cos(3 * x[2]),
                       0.6 * std::sin(3 * x[1]) + 0.8 * std::cos(3 * x[0])};
    };
    const std::string flow = "(sin(3*z) + 0.6*cos(3*y))*grad(x) + (0.8*sin(3*x) + cos(3*z))*grad(y) + "
                             "(0.6*sin(3*y) + 0.8*cos(3*x))*grad(z)";
    for (const char* const shape : shapes) {
        const GeneratedVolume volume = bent_box(shape);
        TraceOptions options;
        options.tolerance = 1e-12;
        options.most_length = 0.7;
        const Vector3 seed{-0.1, 0.05, 0.2};
        const Streamline line = line_of(volume, flow, seed, options);
        REQUIRE(line.begin == TraceEnd::length);
        REQUIRE(line.end == TraceEnd::length);
        const TracePoint &first = line.points.front(), &last = line.points.back();
        CHECK(first.arc_length == Approx(-0.7));
        const double error = std::max(length(minus(reference(abc, seed, last.time), last.position)),
                                      length(minus(reference(abc, seed, first.time), first.position)));
        std::cout << shape << ": ABC flow off by " << error << " after " << line.points.size() << " points\n";
        CHECK(error < 1e-9);
    }
}

TEST_CASE("Errors fall with the tolerance") {
    const GeneratedVolume volume = bent_box("mixed");
    const Vector3 seed{0.5, 0.1, -0.2};
    std::array<double, 2> gaps{};
    for (std::size_t i = 0; i < 2; ++i) {
        TraceOptions options;
        options.direction = TraceDirection::forward;
        options.tolerance = i == 0 ? 1e-6 : 1e-9;
        options.most_length = 2 * std::numbers::pi * std::hypot(seed[0], seed[1]);
        gaps[i] = length(minus(line_of(volume, "x * grad(y) - y * grad(x)", seed, options).points.back().position, seed));
    }
    CHECK(gaps[0] < 1e-4);
    CHECK(gaps[1] < 1e-7);
}

TEST_CASE("Lines tell why they end") {
    const GeneratedVolume box(R"("mesh": "box", "elements": [3, 2, 2], "field": "sphere")");
    const Vector3 seed{0.1, 0.2, 0.3};
    const Streamline through = line_of(box, "2 * grad(x)", seed, {});
    CHECK(through.begin == TraceEnd::left_volume);
    CHECK(through.end == TraceEnd::left_volume);
    CHECK(through.points.front().position[0] == Approx(-1).margin(1e-11));
    CHECK(through.points.back().position[0] == Approx(1).margin(1e-11));
    CHECK(through.points.back().time == Approx(0.45).margin(1e-11));
    CHECK(through.points.front().time == Approx(-0.55).margin(1e-11));

    // Into the origin, more and more slowly.
    CHECK(line_of(box, "-x * grad(x) - y * grad(y) - z * grad(z)", seed, {}).end == TraceEnd::stagnation);
    const Streamline still = line_of(box, "0 * grad(x)", seed, {});
    CHECK(still.end == TraceEnd::stagnation);
    CHECK(still.points.size() == 1);
    CHECK(line_of(box, "grad(x)", {3, 0, 0}, {}).begin == TraceEnd::no_element);
    TraceOptions short_one;
    short_one.most_steps = 2;
    CHECK(line_of(box, "x * grad(y) - y * grad(x)", seed, short_one).end == TraceEnd::steps);

    // From both sides towards the face at x = 0.
    const GeneratedVolume two(R"("mesh": "box", "elements": [2, 1, 1], "field": "sphere")");
    const Streamline stuck = line_of(two, "(element < 0.5 ? 1 : -1) * grad(x)", {-0.5, 0.1, 0.2}, {});
    CHECK(stuck.end == TraceEnd::jump);
    CHECK(stuck.points.back().position[0] == Approx(0).margin(1e-11));
}

TEST_CASE("Seeds on faces and edges begin where the field leads") {
    const GeneratedVolume box(R"("mesh": "box", "elements": 2, "field": "sphere")");
    for (const Vector3& seed : {Vector3{0, 0.3, 0.4}, Vector3{0, 0, 0.4}, Vector3{0, 0, 0}, Vector3{-1, 0, 0}}) {
        const Streamline line = line_of(box, "grad(x)", seed, {});
        CHECK(line.points.front().position[0] == Approx(-1).margin(1e-11));
        CHECK(line.points.back().position[0] == Approx(1).margin(1e-11));
    }
    // Along a face.
    const Streamline along = line_of(box, "grad(y)", {0, -0.4, 0.3}, {});
    CHECK(along.points.back().position[1] == Approx(1).margin(1e-11));
}
