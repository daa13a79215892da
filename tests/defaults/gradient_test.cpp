/*
 * The default gradient against exact ones, on every shape, inside and on the boundary.
 */
#include "checked_snippet.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::Point;

namespace {

/** f = sin(k (2 x + 2 y + z) / 3): k radians a unit length. */
SnippetInstance wave(elvis_shape shape, int k) {
    SnippetInstance instance;
    instance.shape = shape;
    instance.constants = {{"WAVE_NUMBER", k}};
    instance.snippet = {0,
                        "wave",
                        {{"wave.glsl", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n"
                                       "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) { return elvis_mat3(1); }\n"
                                       "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
                                       "    const elvis_real k = elvis_real(WAVE_NUMBER) / elvis_real(3);\n"
                                       "    return elvis_sin(k * (elvis_real(2) * (xi.x + xi.y) + xi.z));\n"
                                       "}\n"}}};
    return instance;
}

/** A polynomial of degree 6, and whether a point was ever asked for outside of the shape: then the value is far off. */
SnippetInstance watched_polynomial(elvis_shape shape) {
    SnippetInstance instance;
    instance.shape = shape;
    const char* outside[] = {"max(max(abs(x), abs(y)), abs(z)) - elvis_real(1)",
                             "max(max(-x, -z) - elvis_real(1), max(abs(y) - elvis_real(1), x + z))",
                             "max(max(-x, max(-y, -z)) - elvis_real(1), max(x + z, y + z))",
                             "max(max(-x, max(-y, -z)) - elvis_real(1), x + y + z + elvis_real(1))"};
    instance.snippet = {
        0,
        "watched",
        {{"watched.glsl", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n"
                          "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) { return elvis_mat3(1); }\n"
                          "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
                          "    const elvis_real x = xi.x;\n    const elvis_real y = xi.y;\n    const elvis_real z = xi.z;\n"
                          "    const elvis_real outside = " +
                              std::string(outside[shape]) +
                              ";\n"
                              "    const elvis_real rounding = elvis_real(2.0e-6LF);\n"
                              "    return x * x * x * y * y * z - z * z * y + x + (outside > rounding ? elvis_real(100) : "
                              "elvis_real(0));\n"
                              "}\n"}}};
    return instance;
}

std::vector<test::CheckPoint> check_points(elvis_shape shape, bool on_boundary) {
    std::vector<test::CheckPoint> points;
    for (const Point& xi : test::points_in(shape, 400, on_boundary)) {
        points.push_back({xi, 0, 0});
    }
    return points;
}

/** Largest error of the gradient, relative to the largest gradient, k. */
double wave_error(elvis_shape shape, Precision precision, int k, bool on_boundary) {
    const auto points = check_points(shape, on_boundary);
    const auto results = check_snippet(wave(shape, k), precision, points);
    double error = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [x, y, z] = points[i].xi;
        const double slope = std::cos(k * (2 * (x + y) + z) / 3) / 3;
        const Point exact{2 * slope, 2 * slope, slope};
        for (std::size_t d = 0; d < 3; ++d) {
            const double gradient = results[i].gradient[d] / k;
            error = std::isfinite(gradient) ? std::max(error, std::abs(gradient - exact[d])) : INFINITY;
        }
        REQUIRE(results[i].value == results[i].value_beside_gradient);
    }
    return error;
}

} // namespace

TEST_CASE("the default gradient is accurate on every shape") {
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_PYRAMID, ELVIS_SHAPE_TETRAHEDRON}) {
        for (const int k : {1, 3, 6, 10}) {
            const double inside64 = wave_error(shape, Precision::float64, k, false);
            const double anywhere64 = wave_error(shape, Precision::float64, k, true);
            const double inside32 = wave_error(shape, Precision::float32, k, false);
            const double anywhere32 = wave_error(shape, Precision::float32, k, true);
            std::cout << test::shape_name(shape) << ", " << k << " radians a unit length: float64 inside " << inside64
                      << ", anywhere " << anywhere64 << "; float32 inside " << inside32 << ", anywhere " << anywhere32 << "\n";
            // Twice what the table in gradient_default.glsl says; it stands for the machines that measure a little differently.
            const std::size_t column = k == 1 ? 0 : k == 3 ? 1 : k == 6 ? 2 : 3;
            CHECK(inside64 < 2 * std::array{3e-13, 4e-13, 3e-13, 2e-12}[column]);
            CHECK(anywhere64 < 2 * std::array{2e-12, 2e-12, 4e-12, 7e-11}[column]);
            CHECK(inside32 < 2 * std::array{3e-5, 3e-5, 3e-5, 8e-5}[column]);
            CHECK(anywhere32 < 2 * std::array{5e-5, 5e-5, 2e-4, 3e-3}[column]);
        }
    }
}

TEST_CASE("the default gradient stays inside the element and is exact for polynomials of degree 6") {
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_PYRAMID, ELVIS_SHAPE_TETRAHEDRON}) {
        const auto points = check_points(shape, true);
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            const auto results = check_snippet(watched_polynomial(shape), precision, points);
            double error = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto& [x, y, z] = points[i].xi;
                const Point exact{3 * x * x * y * y * z + 1, 2 * x * x * x * y * z - z * z, x * x * x * y * y - 2 * z * y};
                for (std::size_t d = 0; d < 3; ++d) {
                    error = std::max(error, std::abs(results[i].gradient[d] - exact[d]));
                }
            }
            const bool is_double = precision == Precision::float64;
            std::cout << test::shape_name(shape) << (is_double ? ", float64" : ", float32") << ": polynomial " << error << "\n";
            CHECK(error < (is_double ? 1e-10 : 1e-3));
        }
    }
}

TEST_CASE("the validation layer has nothing to say about the defaults") {
    CHECK(test::validated_device().validation_messages().empty());
}
