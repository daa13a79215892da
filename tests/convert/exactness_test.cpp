// A polynomial that lies in the target's space is converted with no error but round-off, and the report knows when it is not.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

using namespace elvis;

namespace {

const std::vector<std::string> shapes{"hexahedron", "prism", "tetrahedron", "pyramid"};

// The generator's polynomial of a total degree, and its gradient.
double exact(std::uint32_t degree, const std::array<double, 3>& x, native::Point& gradient) {
    double value = 0;
    gradient = {};
    for (std::uint32_t i = 0; i <= degree; ++i)
        for (std::uint32_t j = 0; i + j <= degree; ++j)
            for (std::uint32_t k = 0; i + j + k <= degree; ++k) {
                const double c = 1.0 / (1.0 + i + 2.0 * j + 3.0 * k);
                const double a = std::pow(x[0], i), b = std::pow(x[1], j), d = std::pow(x[2], k);
                value += c * a * b * d;
                gradient[0] += i == 0 ? 0 : c * i * std::pow(x[0], i - 1) * b * d;
                gradient[1] += j == 0 ? 0 : c * j * a * std::pow(x[1], j - 1) * d;
                gradient[2] += k == 0 ? 0 : c * k * a * b * std::pow(x[2], k - 1);
            }
    return value;
}

struct Errors {
    double value = 0;
    double gradient = 0;
};

// Largest errors at random points, relative to the largest value and gradient.
Errors compare(const ConvertedVolume& volume, std::uint32_t degree) {
    Errors errors;
    double largest = 0, largest_gradient = 0;
    for (std::uint64_t element = 0; element < volume.n_elements(); ++element)
        for (int n = 0; n < 12; ++n) {
            const native::Point xi = random_point(volume.shape(element));
            native::Point expected_gradient, gradient;
            const double expected = exact(degree, volume.position(element, xi), expected_gradient);
            errors.value = std::max(errors.value, std::abs(volume.value(element, 0, xi, &gradient) - expected));
            largest = std::max(largest, std::abs(expected));
            for (std::size_t d = 0; d < 3; ++d) {
                errors.gradient = std::max(errors.gradient, std::abs(gradient[d] - expected_gradient[d]));
                largest_gradient = std::max(largest_gradient, std::abs(expected_gradient[d]));
            }
        }
    return {errors.value / largest, errors.gradient / largest_gradient};
}

std::string describe(const std::string& mesh, const std::string& shape, std::uint32_t geometry_order, std::uint32_t degree) {
    return R"({"generator":1,"mesh":")" + mesh + R"(","shape":")" + shape + R"(","elements":)" + (mesh == "ball" ? "1" : "2") +
           R"(,"geometry_order":)" + std::to_string(geometry_order) + R"(,"field":"polynomial","degree":)" +
           std::to_string(degree) + "}";
}

void check_exact(const std::string& mesh, std::uint32_t geometry_order, const std::vector<std::uint32_t>& degrees) {
    for (const std::string& shape : shapes) {
        Errors worst;
        double residual = 0;
        for (std::uint32_t degree : degrees) {
            CAPTURE(mesh, shape, geometry_order, degree);
            const ConvertedVolume volume(generate(describe(mesh, shape, geometry_order, degree)));
            CHECK(volume.report().fields.at(0).exact);
            CHECK(volume.report().geometry_exact);
            CHECK(volume.report().n_unknown_faces == 0);
            CHECK(volume.description().fields[0].continuity == native::Continuity::continuous);
            const Errors errors = compare(volume, degree);
            CHECK(errors.value <= 1e-11);
            CHECK(errors.gradient <= 1e-9);
            worst = {std::max(worst.value, errors.value), std::max(worst.gradient, errors.gradient)};
            residual = std::max(residual, volume.report().fields[0].residual);
        }
        std::printf("%s of %s, geometry order %u, degrees to %u: largest error %.1e, gradient %.1e, residual %.1e\n",
                    mesh.c_str(), shape.c_str(), geometry_order, degrees.back(), worst.value, worst.gradient, residual);
    }
}

} // namespace

TEST_CASE("polynomials on straight elements are exact, orders 1 to 8", "[convert]") {
    check_exact("box", 1, {1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("polynomials on straight elements are exact, order 14", "[convert]") { check_exact("box", 1, {14}); }

TEST_CASE("polynomials on curved elements are exact at degree times geometry order", "[convert]") {
    check_exact("ball", 1, {1, 2, 5, 8});
    check_exact("ball", 2, {1, 2, 3, 4});
    check_exact("waves", 3, {2});
    check_exact("ball", 4, {2});
}

TEST_CASE("an order too low is reported as not exact", "[convert]") {
    for (const std::string& shape : shapes)
        for (const auto& [mesh, geometry_order, degree] :
             {std::tuple{"box", 1u, 3u}, std::tuple{"box", 1u, 8u}, std::tuple{"ball", 2u, 2u}}) {
            CAPTURE(mesh, shape, degree);
            const std::uint32_t needed = std::string(mesh) == "box" ? degree : geometry_order * degree;
            const SourceVolume source = generate(describe(mesh, shape, geometry_order, degree));
            ConvertOptions options;
            options.order = needed - 1;
            const ConvertedVolume low(source, options);
            CHECK_FALSE(low.report().fields[0].exact);
            CHECK(low.report().fields[0].residual > 1e-9);
            options.order = needed;
            CHECK(ConvertedVolume(source, options).report().fields[0].exact);
            options.order = needed + 1;
            CHECK(ConvertedVolume(source, options).report().fields[0].exact);
        }
}

TEST_CASE("each direction has its own order", "[convert]") {
    const ConvertedVolume volume(generate(
        R"({"generator":1,"mesh":"box","elements":2,"field":"polynomial","coefficients":[[2,3,5,1],[0,1,0,-2],[0,0,0,7]]})"));
    CHECK(volume.description().classes[0].fields[0].order == std::array<std::uint32_t, 3>{2, 3, 5});
    CHECK(volume.report().fields[0].exact);
    const native::Point xi{0.3, -0.2, 0.7};
    const auto x = volume.position(5, xi);
    CHECK(volume.value(5, 0, xi) == Approx(x[0] * x[0] * std::pow(x[1], 3) * std::pow(x[2], 5) - 2 * x[1] + 7).epsilon(1e-13));
}

TEST_CASE("the twisted tetrahedron is converted with its negative Jacobians", "[convert]") {
    const ConvertedVolume volume(generate(R"({"generator":1,"mesh":"twisted-tetrahedron","field":"sphere"})"));
    CHECK(volume.report().fields[0].exact);
    CHECK(volume.description().classes[0].fields[0].order == std::array<std::uint32_t, 3>{4, 4, 4});
    bool has_negative = false;
    for (int n = 0; n < 200; ++n) {
        const native::Point xi = random_point(native::Shape::tetrahedron);
        std::array<native::Point, 3> j;
        const auto x = volume.position(0, xi, &j);
        CHECK(volume.value(0, 0, xi) == Approx(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).margin(1e-14));
        const double determinant = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                   j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                   j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
        has_negative = has_negative || determinant < 0;
    }
    CHECK(has_negative);
}
