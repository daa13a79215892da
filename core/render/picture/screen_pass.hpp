/**
 * @file screen_pass.hpp
 * From a drawn layer on the device to the bytes that screens show: a quarter of what colours are in single precision.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace elvis {

/** The nearest of 256 levels, halves upwards; what is no number counts as 0. */
std::uint8_t screen_level(double channel);

/** What the pass makes of one colour. */
std::array<std::uint8_t, 4> on_screen(const Color& color);

class ScreenPass {
public:
    ScreenPass(const Device& device, Precision precision);

    /** Makes Frame::screen of the layer's colours; it is to be read from there. */
    const Buffer& draw(const Layer& layer);

private:
    const Device& m_device;
    ComposedKernel m_kernel;
    /** The least number of each level but the first, in the precision in use; one more, beyond all. */
    Buffer m_least;
    std::optional<Buffer> m_pixels;
};

} // namespace elvis
