/**
 * @file camera_ray.hpp
 * The ray through a place of a picture, by the camera formulas of scenes.md.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/camera/camera.hpp>

#include <array>

namespace elvis {

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

} // namespace elvis
