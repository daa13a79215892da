/**
 * @file joined_pictures.hpp
 * One picture from those of several volumes.
 */
#pragma once

#include <core/render/frame.hpp>

#include <span>

namespace elvis {

/**
 * Of each pixel the nearest; see draw_together(). All frames are of the same camera and size, and have all buffers.
 * `tolerance`: depths that differ by less do not tell which is nearer. `line_width`: of the widest lines, in pixels.
 */
Frame joined(std::span<const Frame> frames, double tolerance, double line_width);

} // namespace elvis
