/**
 * @file twins.hpp
 * Other pictures and volumes that must show what one shows: the same answers judge them.
 */
#pragma once

#include <core/render/frame.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace elvis::hunt {

/**
 * A picture of an odd part of the width and height, the largest there is: each of its rays is one of the larger picture, too.
 * None where the size has no such part, or where lines are drawn, whose pixels are squares and no rays.
 */
std::optional<FrameRequest> smaller_picture(const FrameRequest& request);

/** The pixel of the larger picture that has the ray of a pixel of the smaller one. */
std::size_t pixel_with_same_ray(const FrameRequest& larger, const FrameRequest& smaller, std::size_t pixel);

/**
 * Writes the same volume with each class in two: every other element goes to a second class, whose fields, and if asked for
 * whose geometry, have coefficients of one order more, all 0. To programs these are other kernels, records and degrees; a
 * reader sees no change.
 */
void split_classes(const std::string& from, const std::string& to, bool raises_geometry);

/**
 * Whether the picture hangs on the bounds that are known of the volume, which are tighter where classes are split: surfaces
 * without end that are shown outside of elements, too, end at three times these.
 */
bool hangs_on_bounds(const FrameRequest& request);

} // namespace elvis::hunt
