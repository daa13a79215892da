/**
 * @file flags_pass.hpp
 * Flags of a picture that is drawn.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <span>

namespace elvis {

class FlagsPass {
public:
    FlagsPass(const Device& device, Precision precision);

    /** Makes the layer's flags those that callers know, and counts pixels by them: on the device, so that none need be read. */
    void settle(const Layer& layer) const;
    const Buffer& counts() const { return m_counts; }
    /** Adds what counts() holds. */
    static void add(std::span<const std::uint32_t> found, FrameCounts& counts);

private:
    ComposedKernel m_kernel;
    Buffer m_counts;
};

} // namespace elvis
