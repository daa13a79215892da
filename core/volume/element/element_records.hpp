/**
 * @file element_records.hpp
 * What point location reads of each element: its number and where Newton's method starts.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/kernel_results.hpp>
#include <core/volume/element/mapping_curvature.hpp>
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
    /** Empty if all curvatures are small, or nothing is known of any element. */
    std::vector<ElementBends> bends;
};

/**
 * Writes the records of a class; the linearizations are computed on the device with the class's snippet. Its kernel is compiled
 * by other threads: make the writers of all classes before the first one writes.
 */
class ElementWriter {
public:
    ElementWriter(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                  const SnippetInstance& instance, Precision precision);

    /** The first elements' linearizations, so that those of all classes are waited for together. */
    void start(KernelResults& results);
    /** With what was read of that. An element that was seen outside of its box is the plugin's fault: an error. */
    ElementCurvatures write(const ElementBoxes& said, RecordBuffer& records, const KernelResults& started);

private:
    void dispatch(std::uint64_t first, KernelResults& results) const;
    std::uint64_t n_at(std::uint64_t first) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const ClassInfo& m_info;
    ElementCurvatures m_curvatures;
    std::vector<float> m_proven;
    ComposedKernel m_kernel;
    Buffer m_output, m_input;
    std::size_t m_started = 0;
};

} // namespace elvis
