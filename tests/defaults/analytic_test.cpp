/*
 * The analytic plugin on the device, its missing functions filled in by the host, against its formulas in double precision.
 */
#include "checked_snippet.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::Point;

namespace {

RuntimeVolume open_sample() {
    return RuntimeVolume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
}

struct ValueAndGradient {
    double value = 0;
    Point gradient{};
};

/** The formulas of the sample file, by field and component. */
ValueAndGradient wave(Point x, double a, Point k, double phase) {
    const double angle = k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + phase;
    const double slope = a * std::cos(angle);
    return {a * std::sin(angle), {slope * k[0], slope * k[1], slope * k[2]}};
}
ValueAndGradient bump(Point x, double a, Point c, double width) {
    const Point d{x[0] - c[0], x[1] - c[1], x[2] - c[2]};
    const double value = a * std::exp(-(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / (width * width));
    const double factor = -2 * value / (width * width);
    return {value, {factor * d[0], factor * d[1], factor * d[2]}};
}
ValueAndGradient pole(Point x, double a, Point c) {
    const Point d{x[0] - c[0], x[1] - c[1], x[2] - c[2]};
    const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double factor = -a / (r * r * r);
    return {a / r, {factor * d[0], factor * d[1], factor * d[2]}};
}
ValueAndGradient operator+(ValueAndGradient a, const ValueAndGradient& b) {
    a.value += b.value;
    for (std::size_t d = 0; d < 3; ++d) {
        a.gradient[d] += b.gradient[d];
    }
    return a;
}
ValueAndGradient exact(std::uint32_t field, std::uint32_t component, Point x) {
    const ValueAndGradient first_wave = wave(x, 1, {3, 2, 1}, 0.5);
    const ValueAndGradient the_bump = bump(x, 2, {0.1, 0.2, 0.3}, 0.7);
    switch (field) {
    case 0:
        return first_wave + wave(x, 0.25, {-1, 5, 2}, 0);
    case 1:
        return the_bump;
    case 2:
        return pole(x, 1, {2.5, 0, 0}) + pole(x, -1, {-2.5, 0.5, 1});
    default:
        return component == 0 ? first_wave : component == 1 ? the_bump : first_wave + the_bump;
    }
}

/** Positions of the sample's corners: its lattice, twisted and rounded as the file has it. */
Point corner(std::uint32_t element, std::uint32_t index) {
    const std::uint32_t lattice[] = {element % 3 + ((index + 1) / 2) % 2, element / 3 % 3 + (index / 2) % 2,
                                     element / 9 + index / 4};
    double x[3];
    for (int d = 0; d < 3; ++d) {
        x[d] = -1 + 2.0 * lattice[d] / 3;
    }
    const double angle = std::acos(-1.0) / 4 * x[2];
    const auto round = [](double number) { return std::round(number * 1e4) / 1e4; };
    return {round(std::cos(angle) * x[0] - std::sin(angle) * x[1]), round(std::sin(angle) * x[0] + std::cos(angle) * x[1]),
            round(x[2])};
}

struct Mapped {
    Point position{};
    /** Columns. */
    std::array<Point, 3> jacobian{};
};

Mapped map(std::uint32_t element, Point xi) {
    Mapped mapped;
    for (std::uint32_t index = 0; index < 8; ++index) {
        const double sign[3] = {index % 4 == 1 || index % 4 == 2 ? 1.0 : -1.0, index % 4 >= 2 ? 1.0 : -1.0,
                                index >= 4 ? 1.0 : -1.0};
        const Point x = corner(element, index);
        const double factor[3] = {(1 + sign[0] * xi[0]) / 2, (1 + sign[1] * xi[1]) / 2, (1 + sign[2] * xi[2]) / 2};
        for (std::size_t d = 0; d < 3; ++d) {
            mapped.position[d] += factor[0] * factor[1] * factor[2] * x[d];
            mapped.jacobian[0][d] += sign[0] / 2 * factor[1] * factor[2] * x[d];
            mapped.jacobian[1][d] += factor[0] * sign[1] / 2 * factor[2] * x[d];
            mapped.jacobian[2][d] += factor[0] * factor[1] * sign[2] / 2 * x[d];
        }
    }
    return mapped;
}

} // namespace

TEST_CASE("the analytic plugin and the host's defaults agree with the formulas") {
    const RuntimeVolume volume = open_sample();
    std::vector<test::CheckPoint> points;
    const auto xis = test::points_in(ELVIS_SHAPE_HEXAHEDRON, 500, true);
    for (std::uint32_t i = 0; i < xis.size(); ++i) {
        points.push_back({xis[i], i % 27, 0});
    }
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        DeviceVolume on_device(test::validated_device(), volume, precision, nullptr);
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            const std::uint32_t n_components = volume.fields()[field].n_components;
            on_device.select(field, 0, std::vector<double>(n_components, 0.0));
            double value_error = 0, position_error = 0, jacobian_error = 0, gradient_error = 0;
            for (std::uint32_t component = 0; component < n_components; ++component) {
                for (auto& point : points) {
                    point.component = component;
                }
                const auto results = check_snippet(on_device.instance(0), precision, points);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const Mapped mapped = map(points[i].element, points[i].xi);
                    const ValueAndGradient wanted = exact(field, component, mapped.position);
                    value_error = std::max(value_error, std::abs(results[i].value - wanted.value));
                    for (std::size_t d = 0; d < 3; ++d) {
                        double slope = 0;
                        for (std::size_t k = 0; k < 3; ++k) {
                            slope += mapped.jacobian[d][k] * wanted.gradient[k];
                            jacobian_error =
                                std::max(jacobian_error, std::abs(results[i].jacobian[d][k] - mapped.jacobian[d][k]));
                        }
                        gradient_error = std::max(gradient_error, std::abs(results[i].gradient[d] - slope));
                        position_error = std::max({position_error, std::abs(results[i].position[d] - mapped.position[d]),
                                                   std::abs(results[i].position_beside_jacobian[d] - mapped.position[d])});
                    }
                }
            }
            const bool is_double = precision == Precision::float64;
            std::cout << "analytic, field " << volume.fields()[field].name << (is_double ? ", float64" : ", float32")
                      << ": value " << value_error << ", gradient " << gradient_error << ", position " << position_error
                      << ", Jacobian " << jacobian_error << "\n";
            CHECK(value_error < (is_double ? 1e-14 : 2e-6));
            CHECK(gradient_error < (is_double ? 3e-11 : 5e-4));
            CHECK(position_error < (is_double ? 1e-15 : 1e-6));
            CHECK(jacobian_error < (is_double ? 1e-15 : 1e-6));
        }
    }
}

TEST_CASE("the analytic plugin's bounds hold all of its elements") {
    const RuntimeVolume volume = open_sample();
    std::vector<double> bounds(6 * volume.n_elements());
    REQUIRE(volume.bounds(0, volume.n_elements(), bounds) == ELVIS_CERTIFIED);
    for (std::uint32_t element = 0; element < 27; ++element) {
        for (const Point& xi : test::points_in(ELVIS_SHAPE_HEXAHEDRON, 200, true)) {
            const Point x = map(element, xi).position;
            for (std::size_t d = 0; d < 3; ++d) {
                REQUIRE(x[d] >= bounds[6 * element + d]);
                REQUIRE(x[d] <= bounds[6 * element + 3 + d]);
            }
        }
    }
}
