// Ribbons turn as what floats in the flow does.

#include <core/streamline/ribbon.hpp>
#include <tests/integrate/integrated.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::GeneratedVolume;

namespace {

constexpr const char* shapes[] = {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};

GeneratedVolume bent_box(const std::string& shape) {
    return GeneratedVolume(test::shape_key(shape) + R"("mesh": "waves", "elements": [4, 3, 3], "geometry_order": 2,
                                                       "amplitude": 0.05, "order": 4, "field": "sphere")");
}

Streamline line_of(const Flow& flow, const Vector3& seed, const TraceOptions& options) {
    const TaskControl control;
    return trace(flow, std::span(&seed, 1), options, control).front();
}

Vector3 about_z(const Vector3& v, double angle) {
    return {std::cos(angle) * v[0] - std::sin(angle) * v[1], std::sin(angle) * v[0] + std::cos(angle) * v[1], v[2]};
}

} // namespace

TEST_CASE("A ribbon in a body that rotates and moves along its axis is carried by the body") {
    for (const char* const shape : shapes) {
        const GeneratedVolume volume = bent_box(shape);
        const Flow flow = Flow(*volume, "x * grad(y) - y * grad(x) + 0.25 * grad(z)", 0).with_spin();
        const Streamline line = line_of(flow, {0.6, 0.03, 0.11}, {});
        const std::vector<Vector3> sides = ribbon_sides(flow, line);
        const auto seed = std::ranges::find(line.points, 0.0, &TracePoint::arc_length) - line.points.begin();
        double off = 0, across = 0, largest_step = 0;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const Vector3 expected = about_z(sides[static_cast<std::size_t>(seed)], line.points[i].time);
            off = std::max(off, length(minus(sides[i], expected)));
            across = std::max(across, std::abs(dot(sides[i], flow.at(line.points[i].at, 0).velocity)));
            largest_step = i > 0 ? std::max(largest_step, length(minus(sides[i], sides[i - 1]))) : 0;
        }
        const double turned = line.points.back().time - line.points.front().time;
        std::cout << shape << ": a ribbon that turns by " << turned << " is off by " << off << ", from across its line by "
                  << across << '\n';
        REQUIRE(turned > 5);
        CHECK(off < 5e-6);
        CHECK(across < 1e-10);
        // Bending and turning by three degrees each.
        CHECK(largest_step < 0.08);
    }
}

TEST_CASE("A ribbon turns by half of the vorticity along its line") {
    // Of this flow, the curl is three times the velocity.
    const std::string abc = "(sin(3*z) + 0.6*cos(3*y))*grad(x) + (0.8*sin(3*x) + cos(3*z))*grad(y) + "
                            "(0.6*sin(3*y) + 0.8*cos(3*x))*grad(z)";
    const GeneratedVolume volume = bent_box("mixed");
    TraceOptions options;
    options.most_length = 0.7;
    const Streamline line = line_of(Flow(*volume, abc, 0).with_spin(), {-0.1, 0.05, 0.2}, options);
    double off = 0;
    for (const TracePoint& point : line.points) {
        off = std::max(off, std::abs(point.turn - 1.5 * point.arc_length));
    }
    std::cout << "turns by " << line.points.back().turn - line.points.front().turn << ", off by " << off << '\n';
    CHECK(line.points.back().turn - line.points.front().turn == Approx(2.1).epsilon(1e-7));
    // Arc lengths between steps are interpolated.
    CHECK(off < 1e-2);
}
