/**
 * @file line_stretches_pass.hpp
 * Where lines pass through the pixels that meet them: what wide lines are drawn around.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <optional>
#include <span>

namespace elvis {

class LineStretchesPass {
public:
    LineStretchesPass(const Device& device, Precision precision);

    /** Of the layer's lines; `isovalues` lack what its values lack. Two words a pixel (shaders/picture/line_stretch.glsl). */
    const Buffer& draw(const Layer& layer, std::span<const double> isovalues);

private:
    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_kernel;
    std::optional<Buffer> m_stretches;
};

} // namespace elvis
