/*
 * Scenes that say how much memory a picture may take, through elvis.hpp.
 */
#include "some_volume.hpp"

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <string>

namespace {

using Catch::Contains;
using elvis::test::convert;
using elvis::test::own_plugins;
using elvis::test::TemporaryFolder;

elvis::scene with_plane(const elvis::context& context) {
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[64, 48]");
    scene.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, -0.1]})");
    return scene;
}

} // namespace

TEST_CASE("A scene with a budget of memory is the same picture, and its statistics tell what it took") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    elvis::scene scene = with_plane(context);
    scene.set("/surfaces/-", R"({"type": "isosurface", "values": [1.2]})");
    const elvis::picture whole = data.render(scene);
    CHECK_THAT(whole.stats(), !Contains("elements_on_device"));

    scene.set("/memory", R"({"device": "1G", "host": "4G"})");
    const elvis::picture within = data.render(scene);
    CHECK_THAT(within.stats(), Contains("\"elements\": 27") && !Contains("\"elements_on_device\": 27"));
    CHECK(within.read<double>(ELVIS_CHANNEL_COLOR) == whole.read<double>(ELVIS_CHANNEL_COLOR));
    CHECK(within.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT) == whole.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT));
    CHECK(within.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS) == whole.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS));

    scene.set("/memory/device", "\"64K\"");
    CHECK_THROWS_WITH(data.render(scene), Contains("on the device, and the budget is 64 KiB"));
    scene.remove("/memory");
    CHECK(data.render(scene).read<double>(ELVIS_CHANNEL_COLOR) == whole.read<double>(ELVIS_CHANNEL_COLOR));
}

TEST_CASE("Frames within a budget of memory are the same pictures, each with its own elements") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    elvis::scene scene = with_plane(context);
    scene.set("/animation", R"({"turntable": {"frames": 2}})");
    const elvis::animation whole = data.animate(scene);
    scene.set("/memory/device", "\"1G\"");
    const elvis::animation within = data.animate(scene);
    for (const std::uint32_t frame : {1u, 0u}) {
        const elvis::picture picture = within.render(frame);
        CHECK_THAT(picture.stats(), !Contains("\"elements_on_device\": 27"));
        CHECK(picture.read<double>(ELVIS_CHANNEL_COLOR) == whole.render(frame).read<double>(ELVIS_CHANNEL_COLOR));
    }
    CHECK(within.remarks() == "[]");
}

TEST_CASE("What has no budget of memory says so") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    elvis::scene scene = context.make_scene();
    CHECK_THROWS_WITH(scene.set("/memory/device", "\"2Q\""), Contains("'2Q' is no size"));
    scene.set("/memory/host", "\"4G\"");
    scene.set("/surfaces/-", R"json({"type": "streamlines", "flow": "grad(p)", "seed_grid": 2})json");
    CHECK_THROWS_WITH(data.render(scene), Contains("cannot be drawn within a budget of memory yet"));
}
