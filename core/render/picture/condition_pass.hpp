/**
 * @file condition_pass.hpp
 * Takes points of a surface out of the picture at which a condition does not hold.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

namespace elvis {

/** What values are compared with, as the device has them. */
struct ConditionLimit {
    double value = 0;
    /** Of the values, by rounding. */
    double error = 0;
    bool is_above = true;
    bool takes_equal = false;
};

class ConditionPass {
public:
    ConditionPass(const Device& device, Precision precision);

    /**
     * Marks the pixels of `layer` whose value in `values` does not meet the limit as cut (CORE_FLAG_CUT), and those as
     * undecided of which rounding decides it. Values that are estimated say so there. Where the surface lies in no element,
     * nothing is cut.
     */
    void judge(const Layer& layer, const Layer& values, const ConditionLimit& limit) const;

private:
    Precision m_precision;
    ComposedKernel m_kernel;
    Buffer m_limit;
};

} // namespace elvis
