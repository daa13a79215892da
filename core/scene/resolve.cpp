#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/scene/resolve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis {

namespace {

/** Looking at a plane: its side towards +z, +y or +x, as for reading a map. */
Vector3 default_direction(std::span<const CutPlane> planes) {
    if (planes.size() != 1) {
        return unit({0.55, 0.45, 0.7});
    }
    const Vector3 normal = unit({planes[0].plane[0], planes[0].plane[1], planes[0].plane[2]});
    const auto largest =
        std::max_element(normal.begin(), normal.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return *largest < 0 ? scaled(normal, -1) : normal;
}

double slope_of(const Camera& camera) { return std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180); }

std::vector<Vector3> corners_of(const std::array<double, 6>& bounds) {
    std::vector<Vector3> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        corners.push_back({bounds[(corner & 1) ? 3 : 0], bounds[(corner & 2) ? 4 : 1], bounds[(corner & 4) ? 5 : 2]});
    }
    return corners;
}

std::vector<Vector3> points_of(const VolumeExtent& extent) {
    return extent.outline.empty() ? corners_of(extent.bounds) : extent.outline;
}

/** Least distance of the eye, and least height of an orthographic picture, with which all points are seen. */
struct Fit {
    double distance = 0, height = 0;
};

/** With a margin; `to_eye` is of unit length, and what is looked at is in the middle of the room. */
Fit fit(std::span<const Vector3> points, const Vector3& look_at, const Vector3& to_eye, const Camera& camera,
        const PictureRoom& room) {
    const Vector3 right = unit(cross(scaled(to_eye, -1), camera.up));
    const Vector3 top = cross(right, scaled(to_eye, -1));
    const double slope = slope_of(camera);
    Fit result;
    for (const Vector3& point : points) {
        const Vector3 relative = minus(point, look_at);
        const double across =
            std::max(std::abs(dot(relative, right)) / room.half_width(), std::abs(dot(relative, top)) / room.half_height());
        result.distance = std::max(result.distance, dot(relative, to_eye) + across / slope);
        result.height = std::max(result.height, 2 * across);
    }
    constexpr double margin = 1.05;
    return {margin * result.distance, margin * result.height};
}

/** In pixels: what is looked at lies in the middle of the room. */
std::array<double, 2> shift_into(const PictureRoom& room) { return {0.5 * (room.right - room.left), -0.5 * room.top}; }

void stand_back(Camera& camera, const Vector3& to_eye, const Fit& fit) {
    camera.eye = plus(camera.look_at, scaled(to_eye, fit.distance));
    camera.height = camera.orthographic ? fit.height : 2 * slope_of(camera) * fit.distance;
}

/** The volume fills the room, wherever a turntable leads the eye: it keeps its distance, so that no picture jumps. */
Camera filling(Camera camera, const Vector3& to_eye, const Scene& scene, const VolumeExtent& extent) {
    const PictureRoom room = room_for_volume(scene);
    const std::vector<Vector3> points = points_of(extent);
    camera.eye = plus(camera.look_at, to_eye);
    SceneAnimation turn;
    if (scene.animation && scene.animation->turntable) {
        // Between directions that are this near to each other, the margin is enough.
        constexpr std::uint32_t enough = 72;
        turn.turntable = scene.animation->turntable;
        turn.turntable->n_frames = std::min(turn.turntable->n_frames, enough);
    }
    Fit all;
    for (const Camera& on_the_way : camera_path(turn, camera)) {
        const Fit one = fit(points, camera.look_at, unit(minus(on_the_way.eye, on_the_way.look_at)), on_the_way, room);
        all = {std::max(all.distance, one.distance), std::max(all.height, one.height)};
    }
    stand_back(camera, to_eye, all);
    camera.image_shift = shift_into(room);
    return camera;
}

} // namespace

bool is_placed(const SceneCamera& camera) {
    return camera.eye || camera.look_at || camera.height || camera.image_shift != std::array<double, 2>{};
}

Camera fitted(const Camera& camera, const VolumeExtent& extent, const PictureRoom& room) {
    Camera result = camera;
    const Vector3 to_eye = unit(minus(camera.eye, camera.look_at));
    result.look_at = middle_of(extent.bounds);
    stand_back(result, to_eye, fit(points_of(extent), result.look_at, to_eye, camera, room));
    result.image_shift = shift_into(room);
    return result;
}

void set_camera(SceneCamera& own, const Camera& camera) {
    own.orthographic = camera.orthographic;
    own.eye = camera.eye;
    own.look_at = camera.look_at;
    own.up = camera.up;
    own.field_of_view = camera.field_of_view;
    own.height = camera.height;
    own.image_shift = camera.image_shift;
}

Camera resolve_camera(const Scene& scene, const VolumeExtent& extent, std::span<const CutPlane> planes) {
    const SceneCamera& own = scene.camera;
    Camera camera;
    camera.orthographic = own.orthographic.value_or(own.height.has_value());
    camera.field_of_view = own.field_of_view.value_or(60.0);
    camera.image_shift = own.image_shift;
    camera.look_at = own.look_at.value_or(middle_of(extent.bounds));
    // Hundreds of roundings of single precision; a tenth of what others clip.
    camera.near = own.near.value_or(1e-4 * diagonal_of(extent.bounds));
    Vector3 to_eye = default_direction(planes);
    if (own.eye) {
        to_eye = minus(*own.eye, camera.look_at);
        if (!(length(to_eye) > 0)) {
            throw Error("camera", "eye and look_at are the same point");
        }
        to_eye = scaled(to_eye, 1 / length(to_eye));
    }
    const bool looks_along_y = std::abs(to_eye[1]) > 0.999;
    camera.up = own.up.value_or(looks_along_y ? Vector3{0, 0, 1} : Vector3{0, 1, 0});
    if (!(length(cross(to_eye, camera.up)) > 1e-9 * length(camera.up))) {
        throw Error("camera", "up has length zero or points along the view");
    }
    if (!is_placed(own)) {
        return filling(camera, to_eye, scene, extent);
    }
    const PictureRoom whole{static_cast<double>(scene.size[0]), static_cast<double>(scene.size[1])};
    const double distance = fit(corners_of(extent.bounds), camera.look_at, to_eye, camera, whole).distance;
    camera.eye = own.eye.value_or(Vector3{camera.look_at[0] + distance * to_eye[0], camera.look_at[1] + distance * to_eye[1],
                                          camera.look_at[2] + distance * to_eye[2]});
    camera.height = own.height.value_or(2 * slope_of(camera) * length(minus(camera.eye, camera.look_at)));
    return camera;
}

CutPlane central_plane(const std::array<double, 6>& bounds) {
    std::size_t shortest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        if (bounds[axis + 3] - bounds[axis] < bounds[shortest + 3] - bounds[shortest]) {
            shortest = axis;
        }
    }
    CutPlane plane;
    plane.plane[shortest] = 1;
    plane.plane[3] = -0.5 * (bounds[shortest] + bounds[shortest + 3]);
    return plane;
}

std::vector<CutPlane> plane_of_flat(const std::array<double, 6>& bounds) {
    double longest = 0, shortest = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        longest = std::max(longest, bounds[axis + 3] - bounds[axis]);
        shortest = std::min(shortest, bounds[axis + 3] - bounds[axis]);
    }
    constexpr double flat = 1e-6;
    return shortest <= flat * longest ? std::vector<CutPlane>{central_plane(bounds)} : std::vector<CutPlane>{};
}

} // namespace elvis
