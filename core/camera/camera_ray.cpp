#include <core/camera/camera_ray.hpp>

#include <cmath>
#include <numbers>

namespace elvis {

ViewAxes axes_of(const Camera& camera) {
    ViewAxes axes{};
    axes.forward = unit(minus(camera.look_at, camera.eye));
    axes.right = unit(cross(axes.forward, camera.up));
    axes.top = cross(axes.right, axes.forward);
    return axes;
}

double slope_of(const Camera& camera) { return std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180); }

std::array<double, 2> picture_coordinates(const Camera& camera, const PictureSize& size, const PicturePoint& place) {
    return {(2 * (place[0] + camera.image_shift[0]) / size.width - 1) * size.aspect(),
            1 - 2 * (place[1] + camera.image_shift[1]) / size.height};
}

Ray ray_through(const Camera& camera, const PictureSize& size, const PicturePoint& place) {
    const auto [s, v] = picture_coordinates(camera, size, place);
    const ViewAxes axes = axes_of(camera);
    const Vector3 across = plus(scaled(axes.right, s), scaled(axes.top, v));
    if (camera.orthographic) {
        return {plus(camera.eye, scaled(across, 0.5 * camera.height)), axes.forward};
    }
    return {camera.eye, unit(plus(axes.forward, scaled(across, slope_of(camera))))};
}

} // namespace elvis
