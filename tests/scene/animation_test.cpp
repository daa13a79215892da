// Which pictures an animation is made of.

#include "fixture.hpp"

#include <core/scene/animation.hpp>
#include <core/scene/scene.hpp>

#include <cmath>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

namespace {

Camera some_camera() {
    Camera camera;
    camera.eye = {3, 0, 1};
    camera.look_at = {1, 0, 0};
    camera.up = {0, 0, 1};
    camera.field_of_view = 40;
    camera.height = 2;
    return camera;
}

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

Scene scene_of(const std::string& animation) {
    const TemporaryFolder folder;
    return read_scene(folder.write("scene.json", R"({"version": 1, "animation": )" + animation + "}"));
}

} // namespace

TEST_CASE("Time steps are all, or from one to another") {
    const auto steps = [](const std::string& text, std::size_t n) {
        return steps_of(parse_time_steps(text).value(), n, "file");
    };
    CHECK(steps("all", 3) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(steps("1:3", 5) == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(steps("0:9:4", 10) == std::vector<std::uint32_t>{0, 4, 8});
    CHECK(steps("3:0:2", 4) == std::vector<std::uint32_t>{3, 1});
    CHECK(steps("2:2", 3) == std::vector<std::uint32_t>{2});
    for (const char* text : {"", "1", "a:b", "1:2:0", "1:2:3:4", "1:", "-1:2", "1:2x", "1.5:2"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_time_steps(text));
    }
    CHECK_THROWS_WITH(steps("0:3", 3), Contains("file") && Contains("there is no step 3"));
}

TEST_CASE("A turntable goes once around, at the same distance, and ends one step before its start") {
    SceneAnimation animation;
    animation.turntable = Turntable{8, std::nullopt, 360};
    const Camera camera = some_camera();
    const std::vector<Camera> path = camera_path(animation, camera);
    REQUIRE(path.size() == 8);
    CHECK(path[0].eye == camera.eye);
    for (const Camera& at : path) {
        CHECK(distance(at.eye, at.look_at) == Approx(distance(camera.eye, camera.look_at)));
        CHECK(at.eye[2] == Approx(1));
        CHECK(at.look_at == camera.look_at);
    }
    // Counterclockwise from above: from +x towards +y.
    CHECK(distance(path[2].eye, {1, 2, 1}) < 1e-12);
    CHECK(distance(path[7].eye, {1 + std::sqrt(2.0), -std::sqrt(2.0), 1}) < 1e-12);
    animation.turntable = Turntable{2, Vector3{0, 5, 0}, 180};
    // A quarter about y, which takes x to -z and z to x.
    CHECK(distance(camera_path(animation, camera)[1].eye, {2, 0, -2}) < 1e-12);
    CHECK(distance(camera_path(animation, camera)[1].up, {1, 0, 0}) < 1e-12);
}

TEST_CASE("A path goes through its key frames, smoothly") {
    SceneAnimation animation;
    animation.key_frames = {{0, Vector3{3, 0, 1}, {}, {}, {}, {}},
                            {40, Vector3{0, 4, 1}, Vector3{0, 0, 0.5}, {}, 20.0, 1.0},
                            {50, Vector3{-5, 1, 0}, {}, Vector3{0, 1, 1}, {}, {}},
                            {90, Vector3{-2, -3, 2}, {}, {}, {}, {}}};
    const Camera camera = some_camera();
    const std::vector<Camera> path = camera_path(animation, camera);
    REQUIRE(path.size() == 91);
    CHECK(path[40].eye == Vector3{0, 4, 1});
    CHECK(path[40].look_at == Vector3{0, 0, 0.5});
    CHECK(path[40].field_of_view == 20);
    CHECK(path[40].up == camera.up);
    CHECK(path[50].look_at == camera.look_at);
    CHECK(path[90].eye == Vector3{-2, -3, 2});
    for (std::size_t i = 0; i + 2 < path.size(); ++i) {
        // No leaps, and no corners: the change of the change is small. A camera that goes along a path of 10 in 50 pictures.
        const auto& [a, b, c] = std::tie(path[i].eye, path[i + 1].eye, path[i + 2].eye);
        const Vector3 middle = {0.5 * (a[0] + c[0]), 0.5 * (a[1] + c[1]), 0.5 * (a[2] + c[2])};
        CAPTURE(i);
        CHECK(distance(a, b) < 1.2);
        CHECK(2 * distance(b, middle) < 0.35);
        // It looks ahead and stands upright all the way.
        const Vector3 away = {b[0] - path[i + 1].look_at[0], b[1] - path[i + 1].look_at[1], b[2] - path[i + 1].look_at[2]};
        CHECK(std::hypot(away[0], away[1], away[2]) > 1.5);
        CHECK(path[i + 1].up[2] > 0);
    }
    animation.key_frames[2].eye = camera.look_at;
    CHECK_THROWS_WITH(camera_path(animation, camera), Contains("key frame 50"));
}

TEST_CASE("Steps and path are spread over the same pictures") {
    SceneAnimation animation;
    animation.turntable = Turntable{6, std::nullopt, 360};
    const Camera camera = some_camera();
    const std::vector<AnimationFrame> frames = animation_frames(animation, {3, 5}, 1, camera);
    REQUIRE(frames.size() == 6);
    std::vector<std::uint32_t> steps;
    for (const AnimationFrame& frame : frames) {
        steps.push_back(frame.time_step);
    }
    CHECK(steps == std::vector<std::uint32_t>{3, 3, 3, 5, 5, 5});
    CHECK(animation_frames(animation, {}, 1, camera)[4].time_step == 1);
    animation.turntable->n_frames = 2;
    const std::vector<AnimationFrame> more_steps = animation_frames(animation, {0, 1, 2, 3}, 0, camera);
    REQUIRE(more_steps.size() == 4);
    CHECK(more_steps[1].camera.eye == camera.eye);
    CHECK(more_steps[2].camera.eye != camera.eye);
}

TEST_CASE("A scene's animation is read, and what is wrong in it is named") {
    const Scene scene = scene_of(
        R"({"time_steps": "0:4:2", "turntable": {"frames": 12, "axis": [0, 1, 0], "degrees": -90}, "frames_a_second": 12.5})");
    REQUIRE(scene.animation);
    CHECK(scene.animation->time_steps->stride == 2);
    CHECK(scene.animation->turntable->n_frames == 12);
    CHECK(scene.animation->turntable->degrees == -90);
    CHECK(scene.animation->frames_a_second == 12.5);
    const Scene keyed = scene_of(R"({"key_frames": [{"frame": 0}, {"frame": 7, "eye": [1, 2, 3], "height": 2}]})");
    CHECK(keyed.animation->key_frames[1].eye == Vector3{1, 2, 3});
    CHECK_THROWS_WITH(scene_of(R"({"time_steps": "some"})"), Contains("animation") && Contains("FIRST:LAST"));
    CHECK_THROWS_WITH(scene_of(R"({"turntable": {"frames": 0}})"), Contains("at least 1"));
    CHECK_THROWS_WITH(scene_of(R"({"turntable": {"frames": 3, "axis": [0, 0, 0]}})"), Contains("length zero"));
    CHECK_THROWS_WITH(scene_of(R"({"turntable": {"frames": 3}, "key_frames": [{"frame": 0}, {"frame": 1}]})"),
                      Contains("two paths"));
    CHECK_THROWS_WITH(scene_of(R"({"key_frames": [{"frame": 1}, {"frame": 2}]})"), Contains("ascending from 0"));
    CHECK_THROWS_WITH(scene_of(R"({"key_frame": []})"), Contains("key_frames"));
}
