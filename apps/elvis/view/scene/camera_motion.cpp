#include "camera_motion.hpp"

#include <cmath>
#include <numbers>

namespace elvis::view {

namespace {

/** By an angle in radians about a unit axis (Rodrigues). */
Vector3 turned(const Vector3& a, const Vector3& axis, double angle) {
    const double c = std::cos(angle);
    return plus(plus(scaled(a, c), scaled(cross(axis, a), std::sin(angle))), scaled(axis, dot(axis, a) * (1 - c)));
}

double distance_of(const Camera& camera) { return length(minus(camera.look_at, camera.eye)); }

/** World height of the picture where the camera looks at. */
double focal_height(const Camera& camera) {
    return camera.orthographic ? camera.height : 2 * slope_of(camera) * distance_of(camera);
}

Camera moved(const Camera& camera, const Vector3& by) {
    Camera result = camera;
    result.eye = plus(camera.eye, by);
    result.look_at = plus(camera.look_at, by);
    return result;
}

} // namespace

std::optional<PicturePoint> project(const Camera& camera, const PictureSize& size, const Vector3& point) {
    const ViewAxes axes = axes_of(camera);
    const Vector3 relative = minus(point, camera.eye);
    const double along = dot(relative, axes.forward);
    if (!camera.orthographic && along <= 1e-9 * distance_of(camera)) {
        return std::nullopt;
    }
    const double half = camera.orthographic ? 0.5 * camera.height : along * slope_of(camera);
    const double s = dot(relative, axes.right) / half;
    const double v = dot(relative, axes.top) / half;
    return PicturePoint{0.5 * size.width * (s / size.aspect() + 1) - camera.image_shift[0],
                        0.5 * size.height * (1 - v) - camera.image_shift[1]};
}

double pixel_length(const Camera& camera, const PictureSize& size, const Vector3& point) {
    const double along = dot(minus(point, camera.eye), axes_of(camera).forward);
    const double height = camera.orthographic ? camera.height : 2 * slope_of(camera) * std::abs(along);
    return height / size.height;
}

Camera orbited(const Camera& camera, const PictureSize& size, const PicturePoint& drag) {
    const ViewAxes axes = axes_of(camera);
    const double about_top = -std::numbers::pi * drag[0] / size.height;
    const double about_right = -std::numbers::pi * drag[1] / size.height;
    const auto turn = [&](const Vector3& a) { return turned(turned(a, axes.right, about_right), axes.top, about_top); };
    Camera result = camera;
    result.eye = plus(camera.look_at, turn(minus(camera.eye, camera.look_at)));
    result.up = unit(turn(axes.top));
    return result;
}

Camera rolled(const Camera& camera, double degrees) {
    const ViewAxes axes = axes_of(camera);
    Camera result = camera;
    result.up = turned(axes.top, axes.forward, degrees * std::numbers::pi / 180);
    return result;
}

Camera panned(const Camera& camera, const PictureSize& size, const PicturePoint& drag) {
    const ViewAxes axes = axes_of(camera);
    const double pixel = focal_height(camera) / size.height;
    return moved(camera, plus(scaled(axes.right, -drag[0] * pixel), scaled(axes.top, drag[1] * pixel)));
}

Camera zoomed(const Camera& camera, const PictureSize& size, const PicturePoint& place, double factor) {
    const auto [s, v] = picture_coordinates(camera, size, place);
    const ViewAxes axes = axes_of(camera);
    // Everything is scaled about the point under the cursor at the distance of what is looked at.
    const double half = 0.5 * focal_height(camera);
    const Vector3 fixed = plus(camera.look_at, plus(scaled(axes.right, s * half), scaled(axes.top, v * half)));
    Camera result = camera;
    result.look_at = plus(fixed, scaled(minus(camera.look_at, fixed), factor));
    if (camera.orthographic) {
        result.eye = plus(camera.eye, minus(result.look_at, camera.look_at));
        result.height = camera.height * factor;
    } else {
        result.eye = plus(fixed, scaled(minus(camera.eye, fixed), factor));
        result.height = 2 * slope_of(result) * distance_of(result);
    }
    return result;
}

Camera with_projection(const Camera& camera, bool orthographic) {
    if (camera.orthographic == orthographic) {
        return camera;
    }
    Camera result = camera;
    result.orthographic = orthographic;
    if (orthographic) {
        result.height = focal_height(camera);
    } else {
        const Vector3 to_eye = scaled(axes_of(camera).forward, -1);
        result.eye = plus(camera.look_at, scaled(to_eye, 0.5 * camera.height / slope_of(camera)));
    }
    return result;
}

const std::vector<StandardView>& standard_views() {
    static const std::vector<StandardView> views = {{"+x", {1, 0, 0}, {0, 0, 1}},
                                                    {"-x", {-1, 0, 0}, {0, 0, 1}},
                                                    {"+y", {0, 1, 0}, {0, 0, 1}},
                                                    {"-y", {0, -1, 0}, {0, 0, 1}},
                                                    {"+z", {0, 0, 1}, {0, 1, 0}},
                                                    {"-z", {0, 0, -1}, {0, 1, 0}},
                                                    {"corner", unit({0.55, 0.45, 0.7}), {0, 1, 0}}};
    return views;
}

Camera from_standard_view(const Camera& camera, const StandardView& view) {
    Camera result = camera;
    result.eye = plus(camera.look_at, view.to_eye);
    result.up = view.up;
    return result;
}

} // namespace elvis::view
