// Animations by the library: the pictures of elvis render.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

constexpr const char* wave = R"({"generator": 1, "mesh": "box", "elements": [2, 2, 2], "order": 2, "field": "taylor-green",
    "time_steps": 3})";

scene some_scene(const context& library, const char* animation) {
    scene shown = library.make_scene();
    shown.set("/image/size", "[40, 30]");
    shown.set("/field", "\"pressure\"");
    shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, -0.4]})");
    shown.set("/animation", animation);
    return shown;
}

} // namespace

TEST_CASE("Frames of an animation are those that elvis render draws, in any order") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, wave));
    scene shown = some_scene(library, R"({"time_steps": "2:0:1", "frames_a_second": 5})");
    const animation frames = volume.animate(shown);
    REQUIRE(frames.info().n_frames == 3);
    CHECK(frames.info().frames_a_second == 5);
    CHECK(frames.time_step(0) == 2);
    CHECK(frames.time_step(2) == 0);

    shown.set("/volume", R"({"path": ")" + folder.path("volume.h5") + R"("})");
    shown.write(folder.path("scene.json"));
    const std::string command = "ELVIS_PLUGIN_PATH='" ELVIS_TEST_PLUGINS "' '" ELVIS_PROGRAM "' render '" +
                                folder.path("scene.json") + "' -o '" + folder.path("frames") + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    for (const std::uint32_t frame : {2u, 0u, 1u}) {
        const std::string own = folder.path("own.png");
        frames.render(frame).write_png(own);
        CHECK(test::read_file(own) == test::read_file(folder.path("frames/frame_000" + std::to_string(frame) + ".png")));
    }
    // The same colours mean the same: a picture of one step alone has the range of that step.
    shown.remove("/animation");
    shown.set("/volume/time_step", "2");
    const picture alone = volume.render(shown);
    CHECK(alone.read<std::uint8_t>(ELVIS_CHANNEL_COLOR) != frames.render(0).read<std::uint8_t>(ELVIS_CHANNEL_COLOR));
    CHECK(alone.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT) == frames.render(0).read<std::int64_t>(ELVIS_CHANNEL_ELEMENT));
}

TEST_CASE("An animation says which surfaces none of its pictures shows, and refuses frames that it does not have") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, wave));
    scene shown = some_scene(library, R"({"turntable": {"frames": 4}})");
    shown.set("/surfaces/-", R"({"type": "sphere", "center": [9, 9, 9], "radius": 0.1})");
    const animation frames = volume.animate(shown);
    REQUIRE(frames.info().n_frames == 4);
    CHECK(frames.remarks() == "[]");
    frames.render(1);
    CHECK_THAT(frames.remarks(), Catch::Contains("sphere hits no pixel"));
    CHECK_THROWS_WITH(frames.render(4), Catch::Contains("4 frames"));
    auto options = detail::sized<elvis_render_options>();
    options.width = options.height = 10;
    CHECK_THROWS_WITH(frames.render(0, options), Catch::Contains("the scene's size"));
    shown.remove("/animation");
    CHECK_THROWS_WITH(volume.animate(shown), Catch::Contains("no animation"));
}
