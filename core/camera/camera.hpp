/**
 * @file camera.hpp
 * Where a picture is seen from.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>

namespace elvis {

/** See the camera formulas in the scene file's documentation. Angles in degrees, lengths in world units. */
struct Camera {
    bool orthographic = false;
    Vector3 eye{};
    Vector3 look_at{};
    /** Not parallel to look_at - eye. */
    Vector3 up{};
    /** Full vertical angle, perspective only; in (0, 180). */
    double field_of_view = 60;
    /** Height of the picture in world units, orthographic only; > 0. */
    double height = 1;
    /** In pixels: added to column and row. */
    std::array<double, 2> image_shift{};
    /** Crossings of rays with surfaces count from this depth on: far above rounding, so that surfaces through the eye are not
     * seen. */
    double near = 0;
};

} // namespace elvis
