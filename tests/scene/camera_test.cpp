// The camera that a scene gets if it does not say where it stands.

#include "fixture.hpp"
#include "stage.hpp"

#include <core/scene/resolve.hpp>
#include <core/volume/outline.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace elvis;
using namespace elvis::test;

namespace {

/** Column and row of a point, by the formulas of the scene file. */
std::array<double, 2> seen(const Camera& camera, const Vector3& point, double width, double height) {
    const Vector3 d = unit(minus(camera.look_at, camera.eye)), right = unit(cross(d, camera.up)), top = cross(right, d);
    const Vector3 relative = minus(point, camera.eye);
    const double half =
        camera.orthographic ? 0.5 * camera.height : dot(relative, d) * std::tan(camera.field_of_view * std::numbers::pi / 360);
    return {0.5 * width * (dot(relative, right) / half * height / width + 1) - camera.image_shift[0],
            0.5 * height * (1 - dot(relative, top) / half) - camera.image_shift[1]};
}

Scene scene_with(const std::string& keys) {
    const TemporaryFolder folder;
    return read_scene(folder.write("scene.json", R"({"version": 1, )" + keys + "}"));
}

struct Seen {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    double width() const { return right - left; }
    double height() const { return bottom - top; }
};

Seen seen(const Camera& camera, const std::vector<Vector3>& points, const Scene& scene) {
    Seen box;
    for (const Vector3& point : points) {
        const auto [x, y] = seen(camera, point, scene.size[0], scene.size[1]);
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y)};
    }
    return box;
}

std::vector<Vector3> ball() {
    std::vector<Vector3> points;
    for (int i = 0; i < 2000; ++i) {
        const double z = 1 - (2 * i + 1) / 2000.0, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
        points.push_back({1 + r * std::cos(angle), r * std::sin(angle) - 2, z});
    }
    return points;
}

const VolumeExtent ball_extent = {{0, -3, -1, 2, -1, 1}, ball()};

} // namespace

TEST_CASE("A ball fills the picture but for a margin, by perspective and without, in any shape of picture") {
    for (const std::array<std::uint32_t, 2> size : {std::array<std::uint32_t, 2>{800, 600}, {600, 600}, {300, 900}}) {
        for (const bool orthographic : {false, true}) {
            for (const double angle : {60.0, 20.0, 100.0}) {
                Scene scene;
                scene.size = size;
                scene.camera.orthographic = orthographic;
                scene.camera.field_of_view = angle;
                const Camera camera = resolve_camera(scene, ball_extent, {});
                const Seen box = seen(camera, ball_extent.outline, scene);
                INFO(size[0] << " x " << size[1] << ", " << orthographic << ", " << angle);
                const double part = std::max(box.width() / size[0], box.height() / size[1]);
                CHECK(part < 0.97);
                CHECK(part > 0.85);
                CHECK((box.left > 0 && box.top > 0 && box.right < size[0] && box.bottom < size[1]));
                CHECK(camera.look_at == Vector3{1, -2, 0});
                CHECK(camera.image_shift == std::array<double, 2>{});
            }
        }
    }
}

TEST_CASE("Annotation has room of its own beside and above the volume") {
    for (const bool at_left : {false, true}) {
        const Scene scene = scene_with(R"("image": {"size": [800, 600], "annotation": {"bar_side": ")" +
                                       std::string(at_left ? "left" : "right") + R"("}})");
        const PictureRoom room = room_for_volume(scene);
        CHECK((at_left ? room.left : room.right) > 80);
        CHECK((at_left ? room.right : room.left) == 0);
        const Seen box = seen(resolve_camera(scene, ball_extent, {}), ball_extent.outline, scene);
        CHECK((box.left > room.left && box.right < 800 - room.right && box.top > room.top && box.bottom < 600));
        CHECK(std::max(box.width() / (800 - room.left - room.right), box.height() / (600 - room.top)) > 0.85);
    }
    const Scene scene = scene_with(R"("image": {"annotation": {"title": "", "color_bars": false}})");
    CHECK(resolve_camera(scene, ball_extent, {}).image_shift == std::array<double, 2>{});
}

TEST_CASE("All pictures of a turntable show the whole volume from one distance") {
    const VolumeExtent beam = {{0, 0, 0, 8, 1, 1}, {}};
    const Scene scene = scene_with(R"("image": {"size": [400, 400]}, "camera": {"up": [0, 1, 0.3]},
                                      "animation": {"turntable": {"frames": 90}})");
    const Camera first = resolve_camera(scene, beam, {});
    std::vector<Vector3> corners;
    for (const double x : {0, 8}) {
        for (const double y : {0, 1}) {
            corners.push_back({x, y, 0});
            corners.push_back({x, y, 1});
        }
    }
    double largest = 0;
    for (const Camera& camera : camera_path(*scene.animation, first)) {
        const Seen box = seen(camera, corners, scene);
        CHECK((box.left > 0 && box.top > 0 && box.right < 400 && box.bottom < 400));
        CHECK(length(minus(camera.eye, camera.look_at)) == Approx(length(minus(first.eye, first.look_at))));
        largest = std::max(largest, box.width());
    }
    CHECK(largest > 0.75 * 400);
}

TEST_CASE("What a scene leaves open of a camera that it places is as it always was") {
    Scene scene = scene_with(R"("image": {"size": [800, 600], "annotation": "default"}, "camera": {"eye": [9, 0, 0]})");
    const Camera camera = resolve_camera(scene, ball_extent, {});
    CHECK(camera.look_at == Vector3{1, -2, 0});
    CHECK(camera.up == Vector3{0, 1, 0});
    CHECK(camera.field_of_view == 60);
    CHECK(camera.image_shift == std::array<double, 2>{});
    CHECK(camera.eye == Vector3{9, 0, 0});

    // The box's corners are in the picture, not only the ball.
    scene.camera = {};
    scene.camera.look_at = Vector3{1, -2, 0};
    const Camera from_afar = resolve_camera(scene, ball_extent, {});
    CHECK(length(minus(from_afar.eye, from_afar.look_at)) == Approx(1.05 * 3.2).epsilon(0.1));
    CHECK(from_afar.image_shift == std::array<double, 2>{});
}

TEST_CASE("The outline of a volume is that of its curved elements, not of their bounds") {
    // A quarter of a pipe, in one element.
    const RuntimeVolume volume(Plugin::load(ELVIS_NURBS_PLUGIN), ELVIS_NURBS_SAMPLE);
    REQUIRE(volume.has_evaluation());
    Background background(2);
    const std::vector<Vector3> outline = outline_points(volume, background);
    std::vector<Vector3> points;
    for (std::uint64_t element = 0; element < volume.n_elements(); ++element) {
        std::vector<double> xi;
        for (int i = 0; i < 13 * 13 * 13; ++i) {
            xi.insert(xi.end(), {i % 13 / 6.0 - 1, i / 13 % 13 / 6.0 - 1, i / 169 / 6.0 - 1});
        }
        std::vector<double> positions(xi.size());
        volume.evaluate_mapping(element, xi, positions, {});
        for (std::size_t at = 0; at < positions.size(); at += 3) {
            points.push_back({positions[at], positions[at + 1], positions[at + 2]});
        }
    }
    const auto reach = [](const std::vector<Vector3>& of, const Vector3& direction) {
        double farthest = -std::numeric_limits<double>::infinity();
        for (const Vector3& point : of) {
            farthest = std::max(farthest, dot(direction, point));
        }
        return farthest;
    };
    double size = 0;
    for (const Vector3& point : points) {
        size = std::max(size, length(minus(point, points.front())));
    }
    for (const Vector3& direction : ball_extent.outline) {
        const Vector3 outwards = minus(direction, {1, -2, 0});
        // As promised, and never more than there is.
        CHECK(reach(outline, outwards) >= reach(points, outwards) - 0.03 * size);
        CHECK(reach(outline, outwards) <= reach(points, outwards) + 0.03 * size);
    }
}

TEST_CASE("Of a plugin that evaluates no mappings the outline is that of the elements' bounds") {
    Stage stage;
    REQUIRE_FALSE(stage.volume.has_evaluation());
    const std::array<double, 6> bounds = stage.renderer.ranges().bounds();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double least = bounds[axis + 3], largest = bounds[axis];
        for (const Vector3& point : stage.renderer.ranges().outline()) {
            least = std::min(least, point[axis]);
            largest = std::max(largest, point[axis]);
        }
        CHECK(least == bounds[axis]);
        CHECK(largest == bounds[axis + 3]);
    }
}
