/**
 * @file element_records.hpp
 * What point location reads of each element: its number and where Newton's method starts.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <vector>

namespace elvis {

/** Number, exponents, six words of the linearized inverse mapping: shaders/element/linearization.glsl. */
inline constexpr std::uint32_t element_record_size = 8;

/** Where elements of a class are said to lie: six numbers each, and what their positions are relative to, three numbers each.
 */
struct ElementBoxes {
    std::vector<float> boxes, origins;
    /** Of positions that are the world's. */
    std::array<float, 3> world_origin{};
};

/** Of the elements of a class (shaders/element/prediction.glsl). */
struct ElementCurvatures {
    std::vector<float> numbers;
    /** Else it is measured. */
    std::vector<bool> are_proven;
};

/**
 * Writes the records of a class; the linearizations are computed on the device with the class's snippet. An element that was
 * seen outside of its box is the plugin's fault: an error.
 */
ElementCurvatures write_elements(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                 const SnippetInstance& instance, Precision precision, const ElementBoxes& said,
                                 RecordBuffer& records);

} // namespace elvis
