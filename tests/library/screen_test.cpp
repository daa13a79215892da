// What windows ask the library for: pictures for screens, points that were clicked on, samples of fields, scenes filled in.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace elvis;
using nlohmann::json;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

scene cut(const context& library) {
    scene shown = library.make_scene();
    shown.set("/image/size", "[48, 36]");
    shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, -0.4]})");
    shown.set("/contours", R"({"count": 6})");
    return shown;
}

elvis_screen_options coarse(std::uint32_t divisor, elvis_screen_flags further = 0) {
    auto options = detail::sized<elvis_screen_options>();
    options.flags = ELVIS_SCREEN_COARSE | further;
    options.divisor = divisor;
    return options;
}

} // namespace

TEST_CASE("A picture for a screen has the colours of the still picture, and coarse ones copy fewer pixels") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    scene shown = cut(library);
    const picture exact = volume.render_for_screen(shown);
    const std::vector<std::uint8_t> colors = exact.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    CHECK(colors == volume.render(shown).read<std::uint8_t>(ELVIS_CHANNEL_COLOR));
    CHECK(exact.info().is_refinable == 1);
    CHECK_THROWS_WITH(exact.read<double>(ELVIS_CHANNEL_DEPTH), Catch::Contains("colours alone"));
    CHECK_THROWS_WITH(exact.write_png(folder.path("a.png")), Catch::Contains("for a screen"));

    const picture small = volume.render_for_screen(shown, coarse(4, ELVIS_SCREEN_NO_LINES));
    REQUIRE(small.info().width == 48);
    const std::vector<std::uint8_t> copied = small.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    REQUIRE(copied.size() == colors.size());
    for (std::size_t row = 0; row < 36; row += 4) {
        CHECK(std::equal(&copied[row * 48 * 4], &copied[row * 48 * 4] + 48 * 4, &copied[(row + 3) * 48 * 4]));
    }
    const std::vector<std::uint8_t> full = volume.render_for_screen(shown, coarse(1)).read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    shown.set("/image/samples", "3");
    CHECK((volume.render_for_screen(shown).read<std::uint8_t>(ELVIS_CHANNEL_COLOR) ==
           volume.render(shown).read<std::uint8_t>(ELVIS_CHANNEL_COLOR)));
    const picture without_samples = volume.render_for_screen(shown, coarse(1));
    CHECK((without_samples.read<std::uint8_t>(ELVIS_CHANNEL_COLOR) == full));
    CHECK(without_samples.info().is_refinable == 1);
    shown.remove("/image/samples");
    shown.remove("/contours");
    CHECK(volume.render_for_screen(shown).info().is_refinable == 0);
    CHECK_THROWS_WITH(volume.render_for_screen(shown, coarse(257)), Catch::Contains("256"));
    auto options = coarse(2);
    options.flags = 0;
    CHECK_THROWS_WITH(volume.render_for_screen(shown, options), Catch::Contains("not coarse"));
}

TEST_CASE("What was clicked on is told with its element and fields") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const scene shown = cut(library);
    const json picked = json::parse(volume.pick(shown, 24, 18));
    REQUIRE(picked["hit"] == true);
    const std::array<double, 3> x = picked["position"];
    CHECK(x[2] == Approx(0.4).margin(1e-5));
    const double p = x[0] * x[0] * x[1] + x[2];
    CHECK(picked["fields"][0]["values"][0].get<double>() == Approx(p).epsilon(1e-9));
    CHECK(picked["fields"][0]["gradients"][2].get<double>() == Approx(1).epsilon(1e-9));
    CHECK(picked["value"].get<double>() == Approx(p).epsilon(1e-5));
    CHECK(picked["element"] == volume.probe({x[0], x[1], x[2]}, {"p"}).elements[0]);
    CHECK(picked["jacobian"] > 0);
    CHECK(json::parse(volume.pick(shown, 0.5, 0.5)) == json{{"hit", false}});
    CHECK_THROWS_WITH(volume.pick(shown, std::nan(""), 1), Catch::Contains("finite"));
}

TEST_CASE("Samples are values of the field, and percentiles lie between them") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const scene shown = library.make_scene();
    std::vector<double> values = volume.sample(shown, "p", 3);
    REQUIRE(values.size() > 300);
    REQUIRE(values.size() <= ELVIS_SAMPLES_A_PIECE);
    CHECK(volume.sample(shown, "2*p", 3).front() == Approx(2 * values.front()));
    CHECK_THROWS_WITH(volume.sample(shown, "p", ELVIS_SAMPLE_PIECES), Catch::Contains("ELVIS_SAMPLE_PIECES"));
    const elvis_range range = volume.range("p");
    std::ranges::sort(values);
    CHECK(values.front() >= range.lower_bound);
    CHECK(values.back() <= range.upper_bound);
    const std::vector<double> parts = volume.percentiles(shown, {0, 0.5, 1});
    CHECK(parts[0] < parts[1]);
    CHECK(parts[1] < parts[2]);
    CHECK(parts[1] == Approx(values[values.size() / 2]).margin(0.1));
    CHECK_THROWS_WITH(volume.percentiles(shown, {2}), Catch::Contains("from 0 to 1"));
}

TEST_CASE("A complete scene draws the same picture, and says where the camera stands") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const std::string file = convert(library, folder);
    const data volume = library.open(file);
    scene shown = library.make_scene();
    shown.set("/image/size", "[40, 30]");
    const scene complete = shown.completed(volume);
    CHECK(json::parse(complete.json())["surfaces"].size() >= 1);
    CHECK(json::parse(complete.json("/camera")).contains("eye"));
    CHECK(volume.render(complete).read<std::uint8_t>(ELVIS_CHANNEL_COLOR) ==
          volume.render(shown).read<std::uint8_t>(ELVIS_CHANNEL_COLOR));

    CHECK(json::parse(library.describe_file(file)) == json{{"kind", "volume"}, {"plugin", "org.elvis.native"}});
    shown.write(folder.path("scene.json"));
    CHECK(json::parse(library.describe_file(folder.path("scene.json")))["kind"] == "scene");
    CHECK(json::parse(library.describe_file(folder.path("input.json")))["kind"] == "foreign");
    CHECK_THROWS_AS(library.describe_file(folder.path("none.h5")), error);
    CHECK(json::parse(library.describe_device())["allocated_bytes"] > 0);
}
