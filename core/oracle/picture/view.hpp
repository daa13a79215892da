/**
 * @file view.hpp
 * Views of cut planes for comparisons with the oracle.
 */
#pragma once

#include "picture.hpp"

namespace elvis::oracle {

/**
 * A cut plane seen in perspective so that the whole volume fits, in a blue-white-red map over [low, high] with clamped ends.
 * `tilt` in degrees turns the view away from the plane's normal, so that pixels do not line up with the mesh.
 */
FrameRequest view_of(const Model& model, const CutPlane& plane, std::uint32_t width, std::uint32_t height, double low,
                     double high, double tilt = 17);

/** Smallest and largest value in a picture. */
std::pair<double, double> value_range(const Picture& picture);

} // namespace elvis::oracle
