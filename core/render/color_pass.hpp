/**
 * @file color_pass.hpp
 * Samples to colours.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/samples.hpp>
#include <core/shader/composer.hpp>

namespace elvis {

class ColorPass {
public:
    ColorPass(const Device& device, Precision precision);

    /** Colours the samples; values of the table lack `offset`, as the samples do. `common_flags` are set on every pixel that is
     * hit. */
    void draw(const SampleTarget& target, const Buffer& colors, const ColorTable& table, const Color& background, double offset,
              std::uint32_t common_flags) const;

private:
    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_color;
};

} // namespace elvis
