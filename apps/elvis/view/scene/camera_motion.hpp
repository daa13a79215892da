/**
 * @file camera_motion.hpp
 * What the hand does to the camera, and where points of the volume are on the picture.
 */
#pragma once

#include "camera.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** Where a point is seen; nothing for what lies behind the eye. */
std::optional<PicturePoint> project(const Camera& camera, const PictureSize& size, const Vector3& point);

/** World length of a pixel at a point. */
double pixel_length(const Camera& camera, const PictureSize& size, const Vector3& point);

/** Turns the camera about what it looks at, as if the hand turned the volume: half a turn over the picture's height. */
Camera orbited(const Camera& camera, const PictureSize& size, const PicturePoint& drag);
/** Turns the picture about its middle. */
Camera rolled(const Camera& camera, double degrees);
/** What is looked at follows the hand. */
Camera panned(const Camera& camera, const PictureSize& size, const PicturePoint& drag);
/** Makes what is looked at 1 / `factor` as large; what is seen at `place` stays there. */
Camera zoomed(const Camera& camera, const PictureSize& size, const PicturePoint& place, double factor);
/** The same at the distance of what is looked at. */
Camera with_projection(const Camera& camera, bool orthographic);

/** Directions from which people look at things, by name: +x, -x, .. and corner. */
struct StandardView {
    std::string name;
    Vector3 to_eye, up;
};
const std::vector<StandardView>& standard_views();
/** From there, at what the camera looks at; to be fitted to the volume. */
Camera from_standard_view(const Camera& camera, const StandardView& view);

} // namespace elvis::view
