#include "camera.hpp"

namespace elvis::view {

Camera camera_of(const nlohmann::json& said) {
    Camera camera;
    camera.eye = {0, 0, 1};
    camera.up = {0, 1, 0};
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

} // namespace elvis::view
