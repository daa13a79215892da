/**
 * @file fold.hpp
 * One picture from those of the parts.
 */
#pragma once

#include <core/parts/part_picture.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/precision.hpp>

#include <span>

namespace elvis {

/** Background alone. */
Frame empty_picture(const FrameRequest& request, Precision precision);

/**
 * The picture of one surface, which is the only one of the request. Of each pixel the nearest that a part shows of its own
 * elements: the part has drawn them together with those around, so that it is the part which owns the element that the whole
 * picture shows. Where parts do not agree on which one that is, rounding decides, and the pixel is flagged as undecided (256).
 * Doubt of any part stays. `pictures`: one of each part, in their order. `diagonal`: of the whole volume's bounds. With lines,
 * pixels near which the part does not see what the picture shows are flagged as undecided (2, 512).
 */
Frame folded(const FrameRequest& request, std::span<const PartPicture> pictures, double diagonal, Precision precision);

/** Adds the folded picture of the surface of this index, as shaders/picture/merge.comp does. */
void add_surface(const Frame& surface, std::size_t index, Frame& picture);
/** When all are added: flags as callers know them, counts of pixels by them. */
void finish_surfaces(Frame& picture);

/**
 * Puts light of the volume in front of what the picture shows: along each ray the runs of all parts, in the order in which they
 * begin. What each is off adds up; where that is more than the tolerance the pixel is flagged (128), and as undecided (256)
 * where runs overlap by more than rounding.
 */
void add_light(const FrameRequest& request, std::span<const PartPicture> pictures, double diagonal, Frame& frame);

} // namespace elvis
