// Plots: where ticks and points lie.
#include <core/base/plot_ticks.hpp>
#include <core/bench/plot.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

using namespace elvis;
using Catch::Matchers::Contains;

namespace {

/** Centres of the circles, in order. */
std::vector<std::array<double, 2>> marks(const std::string& svg) {
    std::vector<std::array<double, 2>> result;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
        std::array<double, 2> mark{};
        REQUIRE(std::sscanf(svg.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &mark[0], &mark[1]) == 2);
        result.push_back(mark);
    }
    return result;
}

} // namespace

TEST_CASE("ticks are round numbers inside the range") {
    CHECK(plot_ticks(0, 10, false) == std::vector<double>{0, 2, 4, 6, 8, 10});
    CHECK(plot_ticks(0, 2048, false) == std::vector<double>{0, 500, 1000, 1500, 2000});
    CHECK(plot_ticks(1, 100, true) == std::vector<double>{1, 2, 5, 10, 20, 50, 100});
    CHECK(plot_ticks(1, 1e6, true) == std::vector<double>{1, 10, 100, 1000, 1e4, 1e5, 1e6});
    CHECK(plot_ticks(3e-12, 1e12, true).size() <= 12);
}

TEST_CASE("points lie where the axes say") {
    const auto linear = marks(to_svg({"t", {"x", false}, {"y", false}, {{"a", {{0, 0}, {5, 50}, {10, 100}}}}}));
    REQUIRE(linear.size() == 3);
    CHECK(linear[1][0] == Approx((linear[0][0] + linear[2][0]) / 2).margin(0.1));
    CHECK(linear[1][1] == Approx((linear[0][1] + linear[2][1]) / 2).margin(0.1));
    CHECK(linear[0][0] < linear[2][0]);
    CHECK(linear[0][1] > linear[2][1]); // up is up
    const auto logarithmic = marks(to_svg({"t", {"x", false}, {"y", true}, {{"a", {{0, 1}, {5, 10}, {10, 100}}}}}));
    CHECK(logarithmic[1][1] == Approx((logarithmic[0][1] + logarithmic[2][1]) / 2).margin(0.1));
}

TEST_CASE("zero on a logarithmic axis is drawn hollow at its foot, below every other value") {
    const std::string svg = to_svg({"t", {"x", false}, {"y", true}, {{"a", {{0, 100}, {1, 1}, {2, 0}}}}});
    const auto points = marks(svg);
    REQUIRE(points.size() == 3);
    CHECK(points[2][1] > points[1][1] + 10);
    CHECK_THAT(svg, Contains(">0</text>") && Contains("fill=\"white\"/>"));
}

TEST_CASE("logarithmic axes hold all points, over few decades and over many") {
    for (const double least : {3.0, 1e-17}) {
        const auto points = marks(to_svg({"t", {"x", false}, {"y", true}, {{"a", {{0, 40}, {1, least}, {2, 7e8}}}}}));
        REQUIRE(points.size() == 3);
        CHECK(points[2][1] >= 44); // the frame's upper edge
        CHECK(points[1][1] <= 380);
        CHECK(points[1][1] > points[0][1]);
        CHECK(points[0][1] > points[2][1]);
    }
}

TEST_CASE("plots without values, and values that are no numbers, do no harm") {
    const double nan = std::nan("");
    CHECK_THAT(to_svg({"empty", {"x", true}, {"y", true}, {}}), Contains("</svg>"));
    CHECK_THAT(to_svg({"one", {"x", false}, {"y", false}, {{"a", {{3, 3}}}}}), !Contains("nan"));
    const std::string svg = to_svg({"t", {"x", false}, {"y", false}, {{"a", {{0, 1}, {1, nan}, {2, 3}}}}});
    CHECK(marks(svg).size() == 2);
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
}

TEST_CASE("text is escaped") {
    CHECK_THAT(to_svg({"a < b & c", {"x", false}, {"y", false}, {{"<s>", {{0, 1}}}}}),
               Contains("a &lt; b &amp; c") && Contains("&lt;s&gt;"));
}
