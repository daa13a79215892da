// Commands that are collected until a result is wanted draw the same picture as those that are waited for one by one.

#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstring>
#include <utility>

namespace elvis::oracle {
namespace {

DeviceOptions with(Submissions submissions) {
    DeviceOptions options = DeviceOptions::from_environment();
    options.validation = true;
    options.submissions = submissions;
    // As on a graphics card: what the host writes and reads passes through other memory.
    options.always_stage = submissions == Submissions::collected;
    return options;
}

template <class Number> bool is_same(const std::vector<Number>& one, const std::vector<Number>& other) {
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(Number)) == 0;
}

/** Twice: the first time it uploads and compiles. */
std::array<Frame, 2> drawn(Renderer& renderer, const RuntimeVolume& volume, const char* scene) {
    const FrameRequest request = make_frame_request(scene_of(nlohmann::json::parse(scene), "scene"), volume, renderer.ranges());
    Frame first = renderer.render(request), second = renderer.render(request);
    return {std::move(first), std::move(second)};
}

struct CollectedPicture {
    const char* name;
    const char* scene;
    /** Of the first picture and the next, at most. These elements are so bent that octants of octants are looked at. */
    std::array<std::uint64_t, 2> submissions;
};

constexpr CollectedPicture pictures[] = {
    {"plane",
     R"({"version": 1, "image": {"size": [60, 45]}, "surfaces": [{"type": "plane", "plane": [0.1, 0.2, 1, 0.1]}]})",
     {11, 4}},
    {"lines",
     R"({"version": 1, "image": {"size": [60, 45]}, "surfaces": [{"type": "plane", "plane": [0.1, 0.2, 1, 0.1],
         "contours": {"count": 5}, "mesh_lines": {}}]})",
     {11, 5}},
    {"boundary",
     R"({"version": 1, "image": {"size": [60, 45]}, "lighting": "default", "surfaces": [{"type": "boundary"}]})",
     {4, 3}},
    {"isosurface",
     R"({"version": 1, "image": {"size": [60, 45]}, "surfaces": [{"type": "isosurface", "values": [0.3]}]})",
     {10, 3}},
    {"volume", R"({"version": 1, "image": {"size": [60, 45]}, "volume_rendering": {}})", {10, 8}}};

} // namespace

TEST_CASE("Collected commands draw the same picture in few submissions") {
    const TemporaryFile file("ball.h5");
    generate(R"({"generator": 1, "mesh": "ball", "shape": "tetrahedron", "elements": [2, 2, 2], "geometry_order": 2, "order": 3,
                 "field": "waves"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Device single(with(Submissions::single)), collected(with(Submissions::collected));
    Renderer one_by_one(single, volume, Precision::float32), together(collected, volume, Precision::float32);
    for (const CollectedPicture& picture : pictures) {
        const std::array<Frame, 2> all_wanted = drawn(one_by_one, volume, picture.scene),
                                   frames = drawn(together, volume, picture.scene);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const Frame &wanted = all_wanted[i], &frame = frames[i];
            INFO(picture.name << " " << i << ": " << frame.submissions << " submissions, else " << wanted.submissions);
            std::printf("%s %zu: %llu submissions, else %llu\n", picture.name, i,
                        static_cast<unsigned long long>(frame.submissions),
                        static_cast<unsigned long long>(wanted.submissions));
            CHECK(frame.counts.hit_pixels == wanted.counts.hit_pixels);
            CHECK(frame.counts.field_evaluations == wanted.counts.field_evaluations);
            CHECK(frame.counts.newton_iterations == wanted.counts.newton_iterations);
            CHECK(frame.counts.isosurface_crossings == wanted.counts.isosurface_crossings);
            CHECK(is_same(frame.color, wanted.color));
            CHECK(is_same(frame.value, wanted.value));
            CHECK(is_same(frame.depth, wanted.depth));
            CHECK(is_same(frame.element, wanted.element));
            CHECK(is_same(frame.flags, wanted.flags));
            CHECK(frame.submissions <= picture.submissions[i]);
        }
    }
    CHECK(collected.validation_messages() == std::vector<std::string>{});
}

} // namespace elvis::oracle
