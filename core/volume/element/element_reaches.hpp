/**
 * @file element_reaches.hpp
 * How far strongly bent elements reach beyond their faces: what dismisses points before Newton's method looks for them
 * (shaders/cut_surface/reach.glsl).
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/** Of one class. Those of an element are unknown, so that they dismiss no point, until they are wanted; then they are kept. */
class ElementReaches {
public:
    /** Whether there is something to know of elements with these curvatures. */
    static bool has_bent(std::span<const float> curvatures);

    /** `data` must have something selected. */
    ElementReaches(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, std::uint32_t element_class);

    /** Forgets all if elements have another shape now. */
    void begin();
    /** Bounds the reaches that kernels want. `also` is read on this occasion. */
    void provide(const Buffer::Read& also);

    /** `core_reaches`. Valid as long as this. */
    FetchBuffer records() const { return {"core_reaches", &m_records}; }
    /** Where kernels say what they want: whether there is anything, then a word for each element. */
    const Buffer& wanted() const { return m_wanted; }

private:
    void clear();
    void bound(std::span<const std::uint32_t> elements);

    const Device& m_device;
    const DeviceVolume& m_data;
    std::uint32_t m_class;
    std::uint64_t m_n_elements;
    RecordBuffer m_records;
    Buffer m_wanted;
    std::vector<bool> m_is_known;
    /** Made when first needed. */
    std::optional<ComposedKernel> m_kernel;
    std::uint64_t m_geometry_version;
};

} // namespace elvis
