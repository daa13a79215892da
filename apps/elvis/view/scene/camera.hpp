/**
 * @file camera.hpp
 * Where a picture is seen from, as a scene says it.
 */
#pragma once

#include <core/camera/camera_ray.hpp>

#include <nlohmann/json.hpp>

namespace elvis::view {

/** Of a scene's "camera", which may say less. */
Camera camera_of(const nlohmann::json& camera);
/** Says all of it; what else is said stays. */
void say_camera(nlohmann::json& said, const Camera& camera);

} // namespace elvis::view
