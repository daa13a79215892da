// Pathlines of flows with closed forms that change in time, in bent elements of every shape.

#include <core/streamline/trace.hpp>
#include <tests/integrate/integrated.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::GeneratedVolume;

namespace {

constexpr const char* shapes[] = {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};

/** At time t the field is (1 + t) r^2. */
GeneratedVolume bent_box(const std::string& shape, int n_steps) {
    return GeneratedVolume(test::shape_key(shape) + R"("mesh": "waves", "elements": [4, 3, 3], "geometry_order": 2,
                           "amplitude": 0.05, "order": 4, "field": "sphere", "time_steps": )" +
                           std::to_string(n_steps));
}

constexpr const char* one_plus_t = "(sphere / (x^2 + y^2 + z^2))";
constexpr const char* turn = "(x * grad(y) - y * grad(x))";

std::string times(const std::string& a, const std::string& b) { return a + " * " + b; }

Streamline line_of(const GeneratedVolume& volume, const std::string& flow, const Vector3& seed, TraceDirection direction,
                   const PathlineOptions& asked = {}) {
    TraceOptions options;
    options.direction = direction;
    options.tolerance = 1e-12;
    const TaskControl control;
    return trace(Flow(*volume, flow, pathline_times(*volume, direction, asked)), std::span(&seed, 1), options, control).front();
}

Vector3 turned_by(const Vector3& x, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
}

/** Of all points of a line that turns by angle(time) about the z axis. */
template <class Angle> double largest_error(const Streamline& line, const Vector3& seed, const Angle& angle) {
    double error = 0;
    for (const TracePoint& point : line.points) {
        error = std::max(error, length(minus(point.position, turned_by(seed, angle(point.time)))));
    }
    return error;
}

double end_error(const Streamline& line, const Vector3& seed, double angle) {
    return length(minus(line.points.back().position, turned_by(seed, angle)));
}

const Vector3 seed{0.62, 0.03, 0.11};

} // namespace

TEST_CASE("A rotation that gets faster evenly is followed exactly by linear interpolation in time") {
    for (const char* const shape : shapes) {
        const GeneratedVolume volume = bent_box(shape, 4);
        // Angular velocity 1 + t.
        const std::string flow = "0.5 * (d(sphere, x) * grad(y) - d(sphere, y) * grad(x))";
        const auto angle = [](double t) { return t + 0.5 * t * t; };
        for (const TimeInterpolation interpolation : {TimeInterpolation::linear, TimeInterpolation::cubic}) {
            const Streamline line = line_of(volume, flow, seed, TraceDirection::forward, {interpolation, {}, {}});
            REQUIRE(line.end == TraceEnd::time);
            CHECK(line.points.back().time == 3);
            CHECK(line.points.back().arc_length == Approx(angle(3) * std::hypot(seed[0], seed[1])).epsilon(1e-9));
            std::cout << shape << (interpolation == TimeInterpolation::linear ? ", linear" : ", cubic") << ": off by "
                      << end_error(line, seed, angle(3)) << " at the end, by " << largest_error(line, seed, angle)
                      << " between steps; doubt " << line.time_doubt << '\n';
            CHECK(end_error(line, seed, angle(3)) < 1e-9);
            // Points between steps lie on cubic curves.
            CHECK(largest_error(line, seed, angle) < 1e-5);
            CHECK(line.time_doubt < 1e-12);
            CHECK(line.time_doubt >= 0);
        }
    }
}

TEST_CASE("Cubic interpolation in time follows what is quadratic, and the doubt tells how far linear is off") {
    const GeneratedVolume volume = bent_box("mixed", 5);
    const std::string flow = times(times(one_plus_t, one_plus_t), turn);
    const auto angle = [](double t) { return (std::pow(1 + t, 3) - 1) / 3; };
    const Streamline cubic = line_of(volume, flow, seed, TraceDirection::forward);
    const Streamline linear = line_of(volume, flow, seed, TraceDirection::forward, {TimeInterpolation::linear, {}, {}});
    std::cout << "angular velocity (1 + t)^2: cubic off by " << end_error(cubic, seed, angle(4)) << ", linear by "
              << end_error(linear, seed, angle(4)) << ", doubt " << cubic.time_doubt << '\n';
    CHECK(end_error(cubic, seed, angle(4)) < 1e-8);
    // Linear interpolation turns by 1/6 more in each of the four intervals.
    CHECK(end_error(linear, seed, angle(4) + 4.0 / 6) < 1e-8);
    // The largest difference of velocities is 1/4 of the radius, the largest speed 25 times that.
    CHECK(cubic.time_doubt == Approx(0.01).epsilon(1e-6));
    CHECK(linear.time_doubt == Approx(0.01).epsilon(1e-6));
}

TEST_CASE("A flow that decays is a streamline at another speed, within the bounds of interpolation") {
    const GeneratedVolume volume(R"("mesh": "box", "shape": "mixed", "elements": [4, 3, 3], "order": 4,
                                    "field": "taylor-green", "time_steps": 4)");
    // Velocities are those of step 0 times exp(-t / 10).
    const double end = 10 * (1 - std::exp(-0.3));
    // Over so long a time the parameter is off by at most that: 1/24 h^4 |v''''| and 1/8 h^2 |v''|.
    const double bounds[] = {3 * 1e-4 / 24, 3 * 1e-2 / 8};
    for (const TimeInterpolation interpolation : {TimeInterpolation::cubic, TimeInterpolation::linear}) {
        const Vector3 start{0.03, 0.8, 0.3};
        const Streamline path = line_of(volume, "velocity", start, TraceDirection::forward, {interpolation, {}, {}});
        REQUIRE(path.end == TraceEnd::time);
        TraceOptions options;
        options.direction = TraceDirection::forward;
        options.tolerance = 1e-12;
        options.most_length = path.points.back().arc_length;
        const TaskControl control;
        const Streamline line = trace(Flow(*volume, "velocity", 0), std::span(&start, 1), options, control).front();
        const double error = std::abs(line.points.back().time - end);
        std::cout << (interpolation == TimeInterpolation::cubic ? "cubic" : "linear") << ": time off by " << error
                  << ", place by " << length(minus(line.points.back().position, path.points.back().position)) << '\n';
        CHECK(error < bounds[static_cast<std::size_t>(interpolation)]);
        CHECK(error > 0);
        CHECK(length(minus(line.points.back().position, path.points.back().position)) < 1e-9);
    }
}

TEST_CASE("Pathlines go back in time to where they came from") {
    const GeneratedVolume volume = bent_box("mixed", 4);
    const std::string flow = times(one_plus_t, turn);
    const auto angle = [](double t) { return t + 0.5 * t * t; };
    const Streamline back =
        line_of(volume, flow, turned_by(seed, angle(2.5)), TraceDirection::backward, {TimeInterpolation::cubic, 2.5, 0.5});
    CHECK(back.begin == TraceEnd::time);
    CHECK(back.points.front().time == Approx(0.5).epsilon(1e-14));
    CHECK(back.points.back().time == 2.5);
    CHECK(length(minus(back.points.front().position, turned_by(seed, angle(0.5)))) < 1e-9);
    const Streamline both =
        line_of(volume, flow, turned_by(seed, angle(1.5)), TraceDirection::both, {TimeInterpolation::cubic, 1.5, {}});
    CHECK(both.points.front().time == 0);
    CHECK(both.points.back().time == 3);
    CHECK(length(minus(both.points.front().position, seed)) < 1e-9);
    CHECK(length(minus(both.points.back().position, turned_by(seed, angle(3)))) < 1e-9);
}

TEST_CASE("Pathlines tell why they end") {
    const GeneratedVolume box(R"("mesh": "box", "elements": [3, 2, 2], "field": "sphere", "time_steps": 3)");
    const Vector3 start{0.1, 0.2, 0.3};
    // At rest at first: x = 0.1 + t^2 / 2.
    const std::string from_rest = "(sphere / (x^2 + y^2 + z^2) - 1) * grad(x)";
    const Streamline out = line_of(box, from_rest, start, TraceDirection::forward);
    CHECK(out.end == TraceEnd::left_volume);
    CHECK(out.points.back().position[0] == Approx(1).margin(1e-10));
    CHECK(out.points.back().time == Approx(std::sqrt(1.8)).margin(1e-10));
    const Streamline inside = line_of(box, from_rest, start, TraceDirection::forward, {TimeInterpolation::cubic, {}, 1.2});
    CHECK(inside.end == TraceEnd::time);
    CHECK(inside.points.back().position[0] == Approx(0.1 + 0.72).margin(1e-10));
    const Streamline still = line_of(box, "0 * grad(x)", start, TraceDirection::forward);
    CHECK(still.end == TraceEnd::time);
    CHECK(length(minus(still.points.back().position, start)) < 1e-14);
    CHECK(line_of(box, "grad(x)", {3, 0, 0}, TraceDirection::forward).end == TraceEnd::no_element);
}

TEST_CASE("Times that pathlines cannot have are refused") {
    const GeneratedVolume one(R"("mesh": "box", "elements": 1, "field": "sphere")");
    CHECK_THROWS_WITH(pathline_times(*one, TraceDirection::forward, {}), Catch::Contains("at least two"));
    const GeneratedVolume three(R"("mesh": "box", "elements": 1, "field": "sphere", "time_steps": 3)");
    CHECK_THROWS_WITH(pathline_times(*three, TraceDirection::forward, {TimeInterpolation::cubic, 2.5, {}}),
                      Catch::Contains("not within the times of the volume, 0 to 2"));
    CHECK_THROWS_WITH(pathline_times(*three, TraceDirection::forward, {TimeInterpolation::cubic, std::nan(""), {}}),
                      Catch::Contains("not within"));
    CHECK_THROWS_WITH(pathline_times(*three, TraceDirection::forward, {TimeInterpolation::cubic, 1.0, 0.5}),
                      Catch::Contains("is not after the start time"));
    CHECK_THROWS_WITH(pathline_times(*three, TraceDirection::both, {TimeInterpolation::cubic, 1.0, 2.0}),
                      Catch::Contains("one direction"));
    CHECK_THROWS_WITH(TimeCourse({0, 1, 1}, TimeInterpolation::linear, "flow.h5"), Catch::Contains("do not ascend"));
}

TEST_CASE("Weights in time are those of the polynomials through the nearest steps") {
    const TimeCourse course({0, 1, 3, 4, 6, 7}, TimeInterpolation::cubic, "test");
    const auto cubic = [](double t) { return 2 - t + 0.5 * t * t - 0.1 * t * t * t; };
    const double steps[] = {0, 1, 3, 4, 6, 7};
    for (const double time : {0.0, 0.4, 1.0, 2.9, 3.0, 5.5, 6.1, 7.0}) {
        const TimeWeights weights = course.at(time);
        double sum = 0;
        for (std::size_t i = 0; i < weights.count; ++i) {
            sum += weights.weights[i] * cubic(steps[weights.steps[i]]);
        }
        CHECK(sum == Approx(cubic(time)).epsilon(1e-12));
    }
    CHECK(course.after(0.5) == 1.0);
    CHECK(course.after(1) == 3.0);
    CHECK_FALSE(course.after(7));
    CHECK(course.before(3) == 1.0);
    CHECK_FALSE(course.before(0));
}
