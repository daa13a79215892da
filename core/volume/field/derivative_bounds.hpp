/**
 * @file derivative_bounds.hpp
 * How large, steep and bent the field on the device is in each element: from the plugin where it can tell, else from samples.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace elvis {

/** The field of which bounds are wanted. */
struct BoundedField {
    std::uint32_t field = 0;
    std::uint32_t time_step = 0;
    /** What the field on the device lacks: one number a component. */
    std::vector<double> offset;
};

/**
 * One record an element of the class, one row of four numbers a component:
 *
 *   H >= sum over i, j of |d^2 f / dxi_i dxi_j|,   L >= sum over i of |df / dxi_i|,   F >= |f - offset|,   certainty
 *
 * over the whole element; in pyramids H bounds (1 - xi_3)/2 times the sum (weighted_derivatives.hpp). Certainty is 0 if all
 * three are certified, 1 if any is estimated. Numbers that are not finite, because the data are not or because they leave the
 * range of the precision, are 3e38. `instance` holds the field lacking its offset.
 */
std::unique_ptr<RecordBuffer> make_derivative_bounds(const Device& device, const RuntimeVolume& volume,
                                                     std::uint32_t element_class, const BoundedField& field,
                                                     const SnippetInstance& instance, Precision precision,
                                                     const TaskControl* control);

} // namespace elvis
