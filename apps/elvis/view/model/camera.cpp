#include "camera.hpp"

#include <cmath>
#include <numbers>

namespace elvis::view {

Camera camera_of(const nlohmann::json& said) {
    Camera camera;
    camera.orthographic = said.value("type", "") == "orthographic";
    camera.eye = said.value("eye", camera.eye);
    camera.look_at = said.value("look_at", camera.look_at);
    camera.up = said.value("up", camera.up);
    camera.field_of_view = said.value("field_of_view", camera.field_of_view);
    camera.height = said.value("height", camera.height);
    camera.image_shift = said.value("image_shift", camera.image_shift);
    return camera;
}

void say_camera(nlohmann::json& said, const Camera& camera) {
    said.update({{"type", camera.orthographic ? "orthographic" : "perspective"},
                 {"eye", camera.eye},
                 {"look_at", camera.look_at},
                 {"up", camera.up},
                 {"field_of_view", camera.field_of_view},
                 {"height", camera.height},
                 {"image_shift", camera.image_shift}});
}

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

} // namespace elvis::view
