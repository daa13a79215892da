// Integrals over planes and isosurfaces against closed forms.
#include "integrated.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elvis::test {
namespace {

using Domain = IntegralRequest::Domain;

IntegralRequest on_plane(const std::array<double, 4>& plane, const std::string& field = "", bool is_flux = false) {
    IntegralRequest request = over(Domain::plane, field, is_flux);
    request.plane = plane;
    return request;
}

IntegralRequest on_isosurface(const std::string& level_field, double isovalue, const std::string& field = "",
                              bool is_flux = false) {
    IntegralRequest request = over(Domain::isosurface, field, is_flux);
    request.level_field = level_field;
    request.isovalue = isovalue;
    return request;
}

TEST_CASE("spheres in straight and in bent elements of every shape have the right area, flux and moments to 1e-8") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron");
    const std::string mesh =
        GENERATE(R"("mesh": "box", "order": 2)", R"("mesh": "waves", "geometry_order": 2, "order": 4, "amplitude": 0.05)");
    const GeneratedVolume volume(shape_key(shape) + mesh + R"(, "elements": 2, "field": "sphere")");
    const double radius = 0.7, area = 4 * std::numbers::pi * radius * radius;
    const Integral found = integral_of(volume, on_isosurface("sphere", radius * radius, "x^2"));
    const Integral flux =
        integral_of(volume, on_isosurface("sphere", radius * radius, "x*grad(x) + y*grad(y) + z*grad(z)", true));
    INFO(shape << ", " << mesh << ": area " << found.measure / area - 1 << " +- " << found.measure_error / area << ", moment "
               << found.value / (area * radius * radius / 3) - 1 << ", flux " << flux.value / (area * radius) - 1 << "; "
               << found.n_evaluations << " evaluations, " << found.n_unresolved << " unresolved");
    CHECK(std::abs(found.measure / area - 1) < 1e-8);
    CHECK(std::abs(found.value / (area * radius * radius / 3) - 1) < 1e-8);
    CHECK(std::abs(flux.value / (area * radius) - 1) < 1e-8);
    CHECK(std::abs(found.measure - area) <= 2 * found.measure_error);
    CHECK(found.is_converged);
}

TEST_CASE("planes through boxes: oblique ones, and ones in faces between elements, which count once") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron", "mixed");
    const GeneratedVolume box(shape_key(shape) + R"("mesh": "box", "elements": [4, 2, 2], "field": "sphere")");
    const Integral hexagon = integral_of(box, on_plane({1, 1, 1, 0}));
    INFO(shape << ": " << hexagon.measure - 3 * std::numbers::sqrt3 << " +- " << hexagon.measure_error << ", "
               << hexagon.n_unresolved);
    CHECK(std::abs(hexagon.measure - 3 * std::numbers::sqrt3) < 1e-8);
    // In faces for some shapes, through elements for others.
    for (const double x : {0.0, 0.5, -0.5, 0.25}) {
        const Integral square = integral_of(box, on_plane({2, 0, 0, -2 * x}, "y^2"));
        INFO(x << ": " << square.measure - 4 << " +- " << square.measure_error << ", " << square.n_unresolved);
        CHECK(std::abs(square.measure - 4) < 1e-8);
        CHECK(std::abs(square.value - 4.0 / 3) < 1e-8);
    }
    // Along the normal that was given.
    CHECK(std::abs(integral_of(box, on_plane({0, 0, 3, 0.3}, "grad(z)", true)).value - 4) < 1e-8);
    CHECK(std::abs(integral_of(box, on_plane({0, 0, -3, 0.3}, "grad(z)", true)).value + 4) < 1e-8);
    CHECK(integral_of(box, on_plane({1, 0, 0, -3})).measure == 0);
}

TEST_CASE("a field that jumps has an isosurface in each element by its own values") {
    const GeneratedVolume box(R"("mesh": "box", "elements": [2, 1, 1], "field": "jump")");
    // Element 1 has h = 0.618...: the field is larger there, and its part of the sphere smaller.
    const double h = static_cast<double>(2654435761u) / 4294967296.0, level = 0.8;
    const double expected = 2 * std::numbers::pi * (level + (level - h));
    const Integral found = integral_of(box, on_isosurface("jump", level));
    INFO(found.measure - expected << " +- " << found.measure_error);
    CHECK(std::abs(found.measure - expected) < 1e-8);
}

TEST_CASE("isosurfaces of expressions, and ones that are missed") {
    const GeneratedVolume box(R"("mesh": "box", "elements": 3, "field": "sphere")");
    // A cylinder around z: 2 pi r times the height.
    const Integral cylinder = integral_of(box, on_isosurface("sqrt(x^2 + y^2 + 1e-30)", 0.6));
    INFO(cylinder.measure - 2.4 * std::numbers::pi << " +- " << cylinder.measure_error);
    CHECK(std::abs(cylinder.measure - 2.4 * std::numbers::pi) < 1e-8);
    const Integral nothing = integral_of(box, on_isosurface("sphere", 7));
    CHECK(nothing.measure == 0);
    CHECK(nothing.n_parts == 0);
    CHECK(nothing.is_converged);
}

} // namespace
} // namespace elvis::test
