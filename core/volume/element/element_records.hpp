/**
 * @file element_records.hpp
 * What point location reads of each element: its number and where Newton's method starts.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <vector>

namespace elvis {

/** Number, exponents, six words of the linearized inverse mapping: shaders/element/linearization.glsl. */
inline constexpr std::uint32_t element_record_size = 8;

/** Where elements of a class are said to lie: six numbers each, and what their positions are relative to, three numbers each.
 */
struct ElementBoxes {
    std::vector<float> boxes, origins;
};

/**
 * Writes the records of a class; the linearizations are computed on the device with the class's snippet. Returns the curvature
 * of each element (shaders/element/prediction.glsl). An element that was seen outside of its box is the plugin's fault: an
 * error.
 */
std::vector<float> write_elements(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                  const SnippetInstance& instance, Precision precision, const ElementBoxes& said,
                                  RecordBuffer& records);

} // namespace elvis
