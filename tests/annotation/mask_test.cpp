#include <core/annotation/mask.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace elvis;

namespace {

double covered(const Mask& mask) {
    double sum = 0;
    for (const float value : mask.coverage) {
        sum += static_cast<double>(value);
    }
    return sum;
}

double area(const std::vector<Point2>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point2 &a = points[i], &b = points[(i + 1) % points.size()];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return std::abs(twice) / 2;
}

} // namespace

TEST_CASE("a polygon covers of every pixel the area that it has in it") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-7, 13);
    double worst = 0;
    for (int repetition = 0; repetition < 200; ++repetition) {
        const std::vector<Point2> triangle = {
            {place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}};
        const Mask mask = polygon_mask(triangle);
        worst = std::max(worst, std::abs(covered(mask) - area(triangle)));
        // One pixel by counting: its part of the triangle on a grid of points.
        const int column = (mask.box.left + mask.box.right) / 2, row = (mask.box.top + mask.box.bottom) / 2;
        int inside = 0;
        constexpr int n = 60;
        for (int i = 0; i < n * n; ++i) {
            const Point2 p = {column + (i % n + 0.5) / n, row + (i / n + 0.5) / n};
            int left = 0, right = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Point2 &a = triangle[k], &b = triangle[(k + 1) % 3];
                ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0 ? left : right) += 1;
            }
            inside += left == 0 || right == 0 ? 1 : 0;
        }
        const std::size_t at = static_cast<std::size_t>(row - mask.box.top) * static_cast<std::size_t>(mask.box.width()) +
                               static_cast<std::size_t>(column - mask.box.left);
        // Counting n² points is off by the points along the edges: at most about 3 / n.
        CHECK(std::abs(static_cast<double>(mask.coverage[at]) - static_cast<double>(inside) / (n * n)) < 3.0 / n);
    }
    // Coverage is stored in single precision: 400 pixels at 6e-8.
    CHECK(worst < 1e-4);
}

TEST_CASE("a rectangle on whole pixels covers them and nothing else") {
    const Mask mask = polygon_mask(std::vector<Point2>{{2, 3}, {5, 3}, {5, 7}, {2, 7}});
    CHECK((mask.box.left == 2 && mask.box.top == 3 && mask.box.right == 5 && mask.box.bottom == 7));
    for (const float value : mask.coverage) {
        CHECK(value == 1.0f);
    }
}

TEST_CASE("degenerate shapes cover nothing") {
    CHECK(covered(polygon_mask(std::vector<Point2>{})) == 0);
    CHECK(covered(polygon_mask(std::vector<Point2>{{1, 1}, {4, 9}})) == 0);
    CHECK(covered(polygon_mask(std::vector<Point2>{{1, 1}, {4, 1}, {9, 1}})) == 0);
}

TEST_CASE("a grown mask covers a disc around a pixel") {
    Mask dot = empty_mask({0, 0, 1, 1});
    dot.coverage[0] = 1;
    constexpr double radius = 6;
    // Half a pixel of the dot's own on each side; the rim is soft.
    CHECK(covered(grown_mask(dot, radius)) == Approx(std::numbers::pi * radius * radius).epsilon(0.03));
}
