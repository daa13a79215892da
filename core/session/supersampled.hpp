/**
 * @file supersampled.hpp
 * Pictures of which each pixel is the mean of several: lines and silhouettes are smooth.
 */
#pragma once

#include <core/render/bands.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Of a request, the picture with n by n pixels for each: lines are n times as wide. */
FrameRequest finer(const FrameRequest& request, std::uint32_t n);

/**
 * Of some rows of that picture, whole rows of the coarse one, the means: in the colours that are displayed; what is transparent
 * counts by how opaque it is. Into the coarse picture's colours.
 */
void take_means(const Frame& fine, const Rows& rows, std::uint32_t n, std::vector<double>& color);

/** Adds doubt about any of a pixel's samples to the flags and counts of the coarse picture. */
void take_doubts(const Frame& fine, const Rows& rows, std::uint32_t n, Frame& frame);

struct SupersampledColors {
    /** As Frame::color, of the request's size. */
    std::vector<double> color;
    double render_milliseconds = 0, device_milliseconds = 0;
};

/** Draws the finer picture, and takes the means. In bands: it is never in memory as a whole. */
SupersampledColors supersampled(std::span<Renderer* const> renderers, const FrameRequest& request, std::uint32_t n,
                                const TaskControl* control);

} // namespace elvis
