/*
 * Certified bounds of first and second derivatives hold everywhere, and are not much larger than need be.
 */
#include "volume_fixture.hpp"

#include <bounds/derivative_weights.hpp>

#include <core/base/error.hpp>
#include <core/volume/field/weighted_derivatives.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

native::Field field_named(const std::string& name, std::uint32_t n_components = 1, native::Transform transform = {}) {
    return {name, "", n_components, native::Continuity::discontinuous, transform, std::nan("")};
}

/** Points of the closed shape, corners and edges among them, where derivatives of polynomials are largest. */
std::vector<double> grid(native::Shape shape, int n) {
    std::vector<double> points;
    const bool is_flat = native::dimension(shape) == 2;
    for (int k = 0; k < (is_flat ? 1 : n); ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto eta = [n](int index) { return -std::cos(std::acos(-1.0) * index / (n - 1)); };
                const native::Point xi = native::expand(shape, {eta(i), eta(j), is_flat ? 0.0 : eta(k)});
                points.insert(points.end(), xi.begin(), xi.end());
            }
    return points;
}

struct Sampled {
    double first = 0, second = 0;
};

/** Largest sums of derivatives at the points, of second ones in pyramids times (1 - xi_3)/2: gradients of the CPU, and central
 * differences of them. */
Sampled sample(const RuntimeVolume& volume, std::uint64_t element, native::Shape shape, const std::vector<double>& points) {
    // Differences over 2e-4 of polynomials are off by h^2/6 of the fourth derivative, below 1e-6 of the largest second one
    // here.
    constexpr double h = 1e-4;
    const bool is_flat = volume.dimension() == 2;
    std::vector<double> second(points.size() / 3, 0.0);
    std::vector<double> gradients(points.size());
    volume.evaluate_field(0, 0, element, points, {}, gradients);
    Sampled largest;
    for (std::size_t at = 0; at < points.size(); at += 3)
        largest.first = std::max(largest.first, std::abs(gradients[at]) + std::abs(gradients[at + 1]) +
                                                    (is_flat ? 0 : std::abs(gradients[at + 2])));
    for (std::size_t direction = 0; direction < (is_flat ? 2u : 3u); ++direction) {
        std::vector<double> before = points, after = points;
        for (std::size_t at = direction; at < points.size(); at += 3) {
            before[at] -= h;
            after[at] += h;
        }
        std::vector<double> upper(points.size());
        volume.evaluate_field(0, 0, element, before, {}, gradients);
        volume.evaluate_field(0, 0, element, after, {}, upper);
        for (std::size_t at = 0; at < points.size(); ++at)
            second[at / 3] += is_flat && at % 3 == 2 ? 0 : std::abs(upper[at] - gradients[at]) / (2 * h);
    }
    for (std::size_t i = 0; i < second.size(); ++i) {
        const double share = shape == native::Shape::pyramid ? 0.5 * (1 - points[3 * i + 2]) : 1;
        largest.second = std::max(largest.second, share * second[i]);
    }
    return largest;
}

std::vector<native::Space> bounded_spaces(std::uint32_t order) {
    using native::Basis;
    using native::Shape;
    const std::array<std::uint32_t, 3> orders{order, order, order};
    return {{Shape::hexahedron, Basis::modified, orders},  {Shape::hexahedron, Basis::gll_lagrange, orders},
            {Shape::prism, Basis::modified, orders},       {Shape::prism, Basis::orthogonal, orders},
            {Shape::tetrahedron, Basis::modified, orders}, {Shape::tetrahedron, Basis::orthogonal, orders},
            {Shape::pyramid, Basis::modified, orders},     {Shape::pyramid, Basis::orthogonal, orders}};
}

std::vector<native::Space> flat_spaces(std::uint32_t order) {
    using native::Basis;
    using native::Shape;
    const std::array<std::uint32_t, 3> orders{order, order, 0};
    return {{Shape::quadrilateral, Basis::modified, orders}, {Shape::triangle, Basis::modified, orders}};
}

double smooth(const native::Point& xi) { return std::sin(1.5 * xi[0] + 0.4) * std::cos(xi[1] - 0.5 * xi[2]) + 0.3 * xi[2]; }

struct Ratios {
    double least = 1e300, largest = 0;
    void add(double ratio) {
        least = std::min(least, ratio);
        largest = std::max(largest, ratio);
    }
};

Ratios check_spaces(const std::vector<native::Space>& spaces,
                    const std::function<double(const native::Point&)>& function = {}) {
    std::vector<ClassPlan> classes;
    for (const native::Space& space : spaces) {
        native::Space geometry = space;
        for (std::uint32_t& order : geometry.order)
            order = std::min(order, 1u);
        classes.push_back({geometry, {space}});
    }
    const TestVolume file(classes, {field_named("f")}, {0.0}, 0, 0.02, function);
    const RuntimeVolume volume = file.open();
    std::vector<DerivativeBounds> bounds(volume.n_elements());
    for (std::uint32_t i = 0; i < spaces.size(); ++i) {
        const std::span<DerivativeBounds> of_class = std::span(bounds).subspan(file.first_element(i), 3);
        REQUIRE(read_weighted_derivatives(volume, i, 0, 0, file.first_element(i), 3, of_class) == ELVIS_CERTIFIED);
    }
    Ratios first, second;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
        INFO(test::describe(spaces[i]));
        const std::vector<double> points = grid(spaces[i].shape, 11);
        for (std::uint64_t local = 0; local < 3; ++local) {
            const std::uint64_t element = file.first_element(i) + local;
            const Sampled sampled = sample(volume, element, spaces[i].shape, points);
            REQUIRE(std::isfinite(bounds[element].second));
            first.add(bounds[element].first / sampled.first);
            // Differences leave 1e-11 of the values; linear functions have nothing else.
            second.add((bounds[element].second + 1e-8) / (sampled.second + 1e-8));
        }
    }
    std::cout << "derivative bounds over sampled maxima, " << (function ? "smooth" : "random") << " fields, order "
              << spaces[0].order[0] << ": first " << first.least << " to " << first.largest << ", second " << second.least
              << " to " << second.largest << "\n";
    CHECK(first.least > 1);
    CHECK(second.least > 1 - 1e-5);
    return second;
}

} // namespace

TEST_CASE("derivatives of random fields stay within the certified bounds") {
    for (std::uint32_t order = 1; order <= 8; ++order) {
        check_spaces(bounded_spaces(order));
        check_spaces(flat_spaces(order));
    }
}

TEST_CASE("derivatives stay within the certified bounds where orders differ between directions") {
    std::vector<native::Space> spaces;
    for (const native::Space& space : test::spaces_of_mixed_order())
        if (space.shape != native::Shape::pyramid)
            spaces.push_back(space);
    check_spaces(spaces);
}

TEST_CASE("bounds of smooth fields are not much larger than their derivatives") {
    for (const std::uint32_t order : {2u, 4u, 6u, 8u}) {
        // Projections of a sine over half a wave: measured 1 to 3.2, hexahedra up to 6.3, pyramids up to 13.2 (order 8).
        CHECK(check_spaces(bounded_spaces(order), smooth).largest < (order < 8 ? 8 : 16));
        CHECK(check_spaces(flat_spaces(order), smooth).largest < 8);
    }
}

TEST_CASE("nothing is claimed where derivatives may grow without bound, but of their product with the distance from the apex") {
    const std::array<std::uint32_t, 3> orders{2, 2, 2};
    const native::Space hexahedron{native::Shape::hexahedron, native::Basis::modified, orders};
    const native::Space pyramid{native::Shape::pyramid, native::Basis::modified, orders};
    const TestVolume file({{hexahedron, {hexahedron, hexahedron}}, {pyramid, {pyramid, pyramid}}},
                          {field_named("f"), field_named("u", 3, native::Transform::covariant)});
    const RuntimeVolume volume = file.open();
    std::vector<DerivativeBounds> bounds(6);
    REQUIRE(volume.derivative_bounds(0, 0, 0, 6, bounds) == ELVIS_CERTIFIED);
    for (std::size_t element = 0; element < 6; ++element) {
        CHECK(std::isfinite(bounds[element].first));
        CHECK(std::isnan(bounds[element].second) == (element >= 3));
    }
    REQUIRE(volume.apex_bounds(0, 0, 3, 3, std::span(bounds).first(3)) == ELVIS_CERTIFIED);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::isfinite(bounds[i].first));
        CHECK(std::isfinite(bounds[i].second));
    }
    bounds.resize(18);
    (void)volume.derivative_bounds(1, 0, 0, 6, bounds);
    for (const DerivativeBounds& bound : bounds) {
        CHECK(std::isnan(bound.first));
        CHECK(std::isnan(bound.second));
    }
}

TEST_CASE("constants and linear fields have bounds to match") {
    const TestVolume file({{bounded_spaces(3)[0], {bounded_spaces(3)[0]}}, {bounded_spaces(3)[4], {bounded_spaces(3)[4]}}},
                          {field_named("f")}, {0.0}, 0, 0.02, [](const native::Point& xi) { return 5 + xi[0] - 2 * xi[2]; });
    const RuntimeVolume volume = file.open();
    std::vector<DerivativeBounds> bounds(6);
    REQUIRE(volume.derivative_bounds(0, 0, 0, 6, bounds) == ELVIS_CERTIFIED);
    for (const DerivativeBounds& bound : bounds) {
        CHECK(bound.first >= 3);
        CHECK(bound.first < 6);
        // Round-off of the test's projection.
        CHECK(bound.second < 1e-8);
    }
}
