/**
 * @file bands.hpp
 * One picture by several devices.
 */
#pragma once

#include <core/render/renderer.hpp>

#include <span>

namespace elvis {

/**
 * Each renderer draws some of the rows, all at the same time. On devices of one kind the picture is that of one of them, to the
 * bit. Counts of work add up: near the borders between bands some of it is done twice. Times are those of the slowest. The
 * renderers are of the same volume, opened once for each. Throws what one of them throws.
 */
Frame render_in_bands(std::span<Renderer* const> renderers, const FrameRequest& request, const TaskControl* control = nullptr);

} // namespace elvis
