/**
 * @file camera.hpp
 * Where a picture is seen from, and the rays through its places: the camera formulas of scenes.md.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <nlohmann/json.hpp>

#include <array>

namespace elvis::view {

struct Camera {
    bool orthographic = false;
    Vector3 eye{0, 0, 1}, look_at{}, up{0, 1, 0};
    /** Full vertical angle, perspective only; degrees. */
    double field_of_view = 60;
    /** Of the picture in world units, orthographic only. */
    double height = 1;
    /** In pixels: added to column and row. */
    std::array<double, 2> image_shift{};
};

/** Of a scene's "camera", which may say less. */
Camera camera_of(const nlohmann::json& camera);
/** Says all of it; what else is said stays. */
void say_camera(nlohmann::json& said, const Camera& camera);

/** Pixels of the picture. */
struct PictureSize {
    double width = 1, height = 1;

    double aspect() const { return width / height; }
};

/** A place on the picture in pixels from its upper left corner; centres of pixels end in a half. */
using PicturePoint = std::array<double, 2>;

/** Unit vectors: along the view, to the right, to the top of the picture. */
struct ViewAxes {
    Vector3 forward, right, top;
};

ViewAxes axes_of(const Camera& camera);

/** Half the picture's height at distance 1, in perspective. */
double slope_of(const Camera& camera);

/** s and v of the formulas. */
std::array<double, 2> picture_coordinates(const Camera& camera, const PictureSize& size, const PicturePoint& place);

struct Ray {
    Vector3 origin, direction; ///< the latter of unit length

    Vector3 at(double depth) const { return plus(origin, scaled(direction, depth)); }
};

Ray ray_through(const Camera& camera, const PictureSize& size, const PicturePoint& place);

} // namespace elvis::view
