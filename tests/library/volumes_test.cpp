// Several volumes in one picture.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

/** At time t the field is (1 + t) r^2. */
constexpr const char* growing = R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 2], "field": "sphere",
    "time_steps": 2})";

using Place = std::array<double, 3>;

scene box_scene(const context& library, const Place& eye = {4, 3, 2.5}, const Place& look_at = {0, 0, 0}) {
    scene shown = library.make_scene();
    shown.set("/image/size", "[96, 64]");
    shown.set("/precision", "\"float64\"");
    shown.set("/lighting", "\"default\"");
    shown.set("/color_map/range", "[0, 6]");
    shown.set("/surfaces/-", R"({"type": "boundary", "contours": {"values": [1.5, 2.5], "width": 1}})");
    const nlohmann::json camera = {{"eye", eye}, {"look_at", look_at}, {"up", {0, 0, 1}}};
    shown.set("/camera", camera.dump());
    return shown;
}

Place less(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct Pixels {
    explicit Pixels(const picture& drawn)
        : color(drawn.read<double>(ELVIS_CHANNEL_COLOR)), depth(drawn.read<double>(ELVIS_CHANNEL_DEPTH)),
          value(drawn.read<double>(ELVIS_CHANNEL_VALUE)), flags(drawn.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS)) {}

    bool is_hit(std::size_t pixel) const { return std::isfinite(depth[pixel]); }
    bool has_color_of(const Pixels& other, std::size_t pixel) const {
        return std::equal(&color[4 * pixel], &color[4 * pixel] + 4, &other.color[4 * pixel]);
    }

    std::vector<double> color, depth, value;
    std::vector<std::uint32_t> flags;
};

std::uint64_t count(const picture& drawn, const char* of) {
    return nlohmann::json::parse(drawn.stats())["counts"][of].get<std::uint64_t>();
}

} // namespace

TEST_CASE("Of two volumes each pixel shows the nearer one, with its own bytes") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, growing));
    // Side by side, and one partly behind the other.
    for (const Place& offset : {Place{0, 3, 0}, Place{-2.5, 0.4, 0.3}}) {
        scene shown = box_scene(library, {9, 1, 4});
        const nlohmann::json further = {{"time_step", 1}, {"offset", offset}};
        shown.set("/volumes/-", further.dump());
        const picture drawn = volume.render(shown);
        scene moved = box_scene(library, less({9, 1, 4}, offset), less({0, 0, 0}, offset));
        moved.set("/volume", R"({"path": "volume.h5", "time_step": 1})");
        const Pixels both(drawn), one(volume.render(box_scene(library, {9, 1, 4}))), other(volume.render(moved));
        std::size_t n_one = 0, n_other = 0, n_background = 0, n_flags = 0;
        for (std::size_t pixel = 0; pixel < both.flags.size(); ++pixel) {
            const bool is_other = other.is_hit(pixel) && (!one.is_hit(pixel) || other.depth[pixel] < one.depth[pixel]);
            const Pixels& shown_one = is_other ? other : one;
            if (!shown_one.is_hit(pixel)) {
                n_background += both.is_hit(pixel) ? 0 : 1;
                continue;
            }
            REQUIRE(both.has_color_of(shown_one, pixel));
            REQUIRE(both.depth[pixel] == shown_one.depth[pixel]);
            REQUIRE(both.value[pixel] == shown_one.value[pixel]);
            // Doubt stays, and more may come.
            n_flags += (shown_one.flags[pixel] & ~both.flags[pixel] & 256u) == 0 ? 0 : 1;
            (is_other ? n_other : n_one) += 1;
        }
        std::cout << n_one << " pixels of one, " << n_other << " of the other, " << n_background << " of none\n";
        CHECK(n_one > 150);
        CHECK(n_other > 40);
        CHECK(n_flags == 0);
        CHECK(count(drawn, "hit_pixels") == n_one + n_other);
        CHECK(count(drawn, "pixels") == both.flags.size());
    }
}

TEST_CASE("Lines where one volume ends in front of another are undecided") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, growing));
    scene shown = box_scene(library, {9, 1, 4});
    shown.set("/volumes/-", R"({"offset": [-2.5, 0.4, 0.3]})");
    const Pixels both(volume.render(shown)), front(volume.render(box_scene(library, {9, 1, 4})));
    std::size_t n_lines_beside = 0, n_lines = 0;
    const std::size_t width = 96;
    for (std::size_t pixel = width + 1; pixel + width + 1 < both.flags.size(); ++pixel) {
        if (front.is_hit(pixel) || (both.flags[pixel] & 1u) == 0) {
            continue;
        }
        ++n_lines;
        for (const std::size_t there : {pixel - 1, pixel + 1, pixel - width, pixel + width}) {
            n_lines_beside += front.is_hit(there) ? 1 : 0;
        }
    }
    CHECK(n_lines > 5);
    CHECK(n_lines_beside == 0);
}

TEST_CASE("Volumes in the same place are undecided all over, and the first is shown") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, growing));
    scene shown = box_scene(library);
    shown.set("/volumes/-", R"({"time_step": 1})");
    const Pixels both(volume.render(shown)), one(volume.render(box_scene(library)));
    for (std::size_t pixel = 0; pixel < both.flags.size(); ++pixel) {
        CHECK(both.has_color_of(one, pixel));
        CHECK((!both.is_hit(pixel) || (both.flags[pixel] & 256u) != 0));
    }
}

TEST_CASE("Colours of several volumes mean the same, and the camera sees all of them") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const std::string path = convert(library, folder, growing);
    const data volume = library.open(path);
    scene shown = library.make_scene();
    shown.set("/image/size", "[160, 90]");
    shown.set("/image/annotation", "\"default\"");
    shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, 0]})");
    // One is a file of its own.
    shown.set("/volumes/-", nlohmann::json{{"path", path}, {"time_step", 1}, {"offset", {2.5, 0, 0}}}.dump());
    const picture drawn = volume.render(shown);
    const auto bars = nlohmann::json::parse(drawn.color_bars());
    REQUIRE(bars.size() == 1);
    const auto& points = bars[0]["points"];
    CHECK(points[0][0].get<double>() == Approx(0).margin(0.01));
    CHECK(points[points.size() - 1][0].get<double>() == Approx(6).epsilon(1e-3));
    const std::vector<std::int64_t> elements = drawn.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT);
    std::size_t n_left = 0, n_right = 0;
    for (std::size_t pixel = 0; pixel < elements.size(); ++pixel) {
        (pixel % 160 < 80 ? n_left : n_right) += elements[pixel] >= 0 ? 1 : 0;
    }
    CHECK(n_left > 500);
    CHECK(n_right > 100);
}

TEST_CASE("Several volumes are shown on a screen as in a still picture, and copied from fewer pixels") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, growing));
    scene shown = box_scene(library);
    shown.set("/volumes/-", R"({"offset": [3, 0, 0]})");
    const picture still = volume.render(shown), screen = volume.render_for_screen(shown);
    CHECK(screen.info().n_hit_pixels == still.info().n_hit_pixels);
    const std::vector<std::uint8_t> colors = screen.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    CHECK(colors == still.read<std::uint8_t>(ELVIS_CHANNEL_COLOR));
    auto coarse = detail::sized<elvis_screen_options>();
    coarse.flags = ELVIS_SCREEN_COARSE;
    coarse.divisor = 4;
    const picture small = volume.render_for_screen(shown, coarse);
    CHECK(small.info().width == screen.info().width);
    const std::vector<std::uint8_t> copied = small.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    REQUIRE(copied.size() == colors.size());
    CHECK(std::equal(copied.begin(), copied.begin() + 4, copied.begin() + 4));
    CHECK(copied != colors);
}

TEST_CASE("What is not drawn of several volumes is refused") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, growing));
    const auto with = [&](const char* pointer, const char* value) {
        scene shown = box_scene(library);
        shown.set("/volumes/-", R"({"offset": [3, 0, 0]})");
        shown.set(pointer, value);
        return shown;
    };
    CHECK_THROWS_WITH(volume.render(with("/surfaces/0/opacity", "0.5")),
                      Catch::Contains("seen through cannot be drawn of several"));
    CHECK_THROWS_WITH(volume.render(with("/surfaces/-", R"({"type": "wireframe"})")), Catch::Contains("edges of elements"));
    CHECK_THROWS_WITH(volume.render(with("/image/samples", "2")), Catch::Contains("several samples"));
    CHECK_THROWS_WITH(volume.render(with("/volume_rendering", "{}")), Catch::Contains("the volume itself"));
    CHECK_THROWS_WITH(volume.render(with("/volumes/0/field", "\"nothing\"")), Catch::Contains("nothing"));
    CHECK_THROWS_WITH(volume.render(with("/volumes/0/time_step", "5")), Catch::Contains("no step 5"));
    CHECK_THROWS_WITH(volume.render(with("/volumes/0/path", "\"/no/such/file.h5\"")), Catch::Contains("/no/such/file.h5"));
    CHECK_THROWS_WITH(with("/volumes/0/plugin", "\"a.b\""), Catch::Contains("goes with 'path'"));
    CHECK_THROWS_WITH(with("/volumes/0/pth", "\"a.h5\""), Catch::Contains("path"));
    const scene shown = with("/camera/up", "[0, 0, 1]");
    CHECK_THROWS_WITH(volume.pick(shown, 10, 10), Catch::Contains("is of one volume"));
}
