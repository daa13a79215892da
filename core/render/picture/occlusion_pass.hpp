/**
 * @file occlusion_pass.hpp
 * Keeps what is drawn next to what opaque surfaces, drawn before, do not hide.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <cstdint>

namespace elvis {

class OcclusionPass {
public:
    OcclusionPass(const Device& device, Precision precision);

    /** Puts opaque surfaces into an empty layer: what passes find behind them is not drawn. `depths` as of MergePass. */
    void begin(const Layer& layer, const Buffer& depths) const;
    /** Takes them out again, before anything else is done with the layer. Returns in how many pixels they still were. */
    std::uint32_t end(const Layer& layer, const Buffer& depths) const;
    /** Takes out what they hide, of a layer that was drawn without begin() and end(), too. Returns of how many pixels. */
    std::uint32_t hide(const Layer& layer, const Buffer& depths) const;

private:
    enum class Step : std::uint32_t { put, take, hide };
    void run(const Layer& layer, const Buffer& depths, Step step) const;
    std::uint32_t counted(const Layer& layer, const Buffer& depths, Step step) const;

    ComposedKernel m_kernel;
    Buffer m_counts;
};

} // namespace elvis
