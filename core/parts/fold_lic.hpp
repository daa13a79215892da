/**
 * @file fold_lic.hpp
 * Line integral convolution on a surface whose parts were drawn apart.
 *
 * Streaks follow the vectors across the faces between parts, so no part can draw its own: all parts draw the three components
 * of the vector, the first process gets these pictures put together, and averages noise along the curves, as in pictures of the
 * whole (core/render/picture/lic_pass.hpp), and parts then draw colours with the factors that come of it.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/vulkan/device.hpp>

#include <array>
#include <vector>

namespace elvis {

/** A request of one surface with line integral convolution, as one for the pictures of its vectors' components. */
FrameRequest component_request(const FrameRequest& alone, std::size_t component);

/**
 * FrameRequest::shades of the surface: from the folded pictures of the components. `bounds`: of the whole volume; `error`: how
 * far off a vector may be.
 */
std::vector<double> shades_of(const Device& device, Precision precision, const FrameRequest& alone,
                              const std::array<Frame, 3>& components, const std::array<double, 6>& bounds, double error);

} // namespace elvis
