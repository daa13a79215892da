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

struct SupersampledColors {
    /** As Frame::color, of the request's size. */
    std::vector<double> color;
    double render_milliseconds = 0, device_milliseconds = 0;
};

/**
 * Draws n by n pixels for each of the request's, and takes their mean, in the colours that are displayed; what is transparent
 * counts by how opaque it is. Lines are n times as wide. In bands: the fine picture is never in memory as a whole.
 */
SupersampledColors supersampled(std::span<Renderer* const> renderers, const FrameRequest& request, std::uint32_t n,
                                const TaskControl* control);

} // namespace elvis
