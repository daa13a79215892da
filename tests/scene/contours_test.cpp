// Contours of which a scene says little.

#include "fixture.hpp"
#include "stage.hpp"

#include <cmath>

using namespace elvis;
using namespace elvis::test;

namespace {

std::string scene(const std::string& contours) {
    return R"("field": "x", "color_map": {"name": "gray", "range": [0.03, 1]}, "image": {"size": [40, 30]},
              "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}], "contours": )" +
           contours;
}

} // namespace

TEST_CASE("Contours of which nothing is said are at round values, each in what stands out from the map") {
    Stage stage;
    const FrameRequest request = stage.request(scene("{}"));
    REQUIRE(request.surfaces[0].contours);
    const Contours& contours = *request.surfaces[0].contours;
    REQUIRE(contours.values.size() == 9);
    REQUIRE(contours.inks.size() == 9);
    for (std::size_t i = 0; i < 9; ++i) {
        const double level = 0.1 * static_cast<double>(i + 1);
        CHECK(contours.values[i] == Approx(level));
        // Of gray the brightness is about the value.
        if (std::abs(level - 0.5) > 0.15) {
            CHECK(contours.inks[i][0] == (level > 0.5 ? 0 : 1));
        }
    }
    CHECK(stage.request(scene(R"({"range": [0, 5]})")).surfaces[0].contours->values ==
          std::vector<double>{0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5});
}

TEST_CASE("Contours have the colours and the values that they are given") {
    Stage stage;
    const auto contours = [&](const std::string& text) { return *stage.request(scene(text)).surfaces[0].contours; };
    CHECK(contours(R"({"values": [0.2, 0.7], "color": [1, 0, 0]})").inks.empty());
    CHECK(contours(R"({"values": [0.2, 0.7], "color": [1, 0, 0]})").color(1) == Rgb{1, 0, 0});
    const Contours of_map = contours(R"({"values": [0.2, 0.7], "color": "map"})");
    CHECK(of_map.inks.empty());
    CHECK_FALSE(of_map.style.color);
    CHECK(contours(R"({"count": 3})").values.size() == 3);
    CHECK_FALSE(stage.request(scene(R"({"values": []})")).surfaces[0].contours);
}

TEST_CASE("Whatever colour contours are drawn in, the pixels that are said to meet them are the same") {
    Stage stage;
    const auto frame = [&](const std::string& text) { return stage.renderer.render(stage.request(scene(text))); };
    const Frame own = frame(R"({"values": [0.2, 0.7]})");
    const Frame red = frame(R"({"values": [0.2, 0.7], "color": [1, 0, 0]})");
    const Frame map = frame(R"({"values": [0.2, 0.7], "color": "map"})");
    CHECK(own.flags == red.flags);
    CHECK(own.flags == map.flags);
    std::size_t n_black = 0, n_white = 0;
    for (std::size_t pixel = 0; pixel < own.flags.size(); ++pixel) {
        const Color color = {own.color[4 * pixel], own.color[4 * pixel + 1], own.color[4 * pixel + 2], 1};
        if ((own.flags[pixel] & pixel_flag::contour) != 0) {
            const double nearer = std::abs(own.value[pixel] - 0.2) < std::abs(own.value[pixel] - 0.7) ? 1 : 0;
            CHECK(color == Color{nearer, nearer, nearer, 1});
            (nearer > 0 ? n_white : n_black) += 1;
            CHECK(red.color[4 * pixel] == 1);
        }
    }
    CHECK(n_black > 5);
    CHECK(n_white > 5);
}

TEST_CASE("A surface on which the field has a contour's value everywhere is not painted over by it") {
    Stage stage;
    const auto frame = [&](const std::string& color) {
        return stage.renderer.render(stage.request(
            R"("field": "z", "color_map": {"name": "gray", "range": [-1, 1]}, "image": {"size": [40, 30]},
               "surfaces": [{"type": "plane", "plane": [0, 0, 1, -0.1]}], "contours": {"values": [0.1])" +
            color + "}"));
    };
    const Frame own = frame(""), red = frame(R"(, "color": [1, 0, 0])");
    REQUIRE(own.counts.undecided_contour_pixels > 100);
    std::size_t n_gray = 0, n_red = 0;
    for (std::size_t pixel = 0; pixel < own.flags.size(); ++pixel) {
        if ((own.flags[pixel] & pixel_flag::contour_undecided) != 0) {
            n_gray += own.color[4 * pixel] > 0.3 && own.color[4 * pixel] < 0.8 ? 1 : 0;
            n_red += red.color[4 * pixel] == 1 && red.color[4 * pixel + 1] == 0 ? 1 : 0;
        }
    }
    // All of them but those along the volume's border, in which nothing may be seen.
    CHECK(n_gray > 150);
    CHECK(n_red > 150);
}
