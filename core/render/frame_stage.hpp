/**
 * @file frame_stage.hpp
 * Pictures in stages while somebody looks: a small one while things move, then all of it.
 */
#pragma once

#include <core/render/frame.hpp>

#include <cstdint>

namespace elvis {

/** What is on the screen. */
enum class FrameStage {
    /** Nothing that was asked for. */
    none,
    /** Fewer pixels, and as coarse as `full`, without lines where these take too long: while things move. */
    moving,
    /** Every pixel, but volume rendering to a hundredth of a channel, and lines that are looked for in few subpixels. */
    full,
    /** The request itself: to the byte what `elvis render` draws of it. */
    exact
};

/** The request as a stage draws it, `divisor` pixels across and down in one; contours and mesh lines may be left out while
 * things move. */
FrameRequest request_for(const FrameRequest& request, FrameStage stage, std::uint32_t divisor, bool with_lines = true);

/** Whether `full` leaves anything to `exact`: surfaces without lines are pixel-exact as soon as every pixel is drawn. */
bool has_refinement(const FrameRequest& request);

} // namespace elvis
