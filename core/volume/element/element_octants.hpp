/**
 * @file element_octants.hpp
 * Octants of strongly bent elements, each so small that its mapping is nearly linear: where points are looked for that Newton's
 * method may miss in the whole element (shaders/cut_surface/open_points.comp).
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/isosurface/octant_records.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Octants of a class for which there is room, and what that takes on the device, however few elements there are. */
inline constexpr std::uint64_t most_octants = 1u << 18;
inline constexpr std::uint64_t octants_bytes = most_octants * (4 * octant_size + 2 * sizeof(HierarchyNode));

/** Of one class. They are made for the elements that the kernel asks for, and kept. */
class ElementOctants {
public:
    /** `data` must have something selected. */
    ElementOctants(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, std::uint32_t element_class);

    /** Before a search: forgets octants of elements that have another shape now, and all if there was no room for some. */
    void begin();
    /** Makes octants of the elements that were asked for. Returns whether any was. */
    bool provide();

    /** `core_octants`, and `core_octant_nodes`: a hierarchy over the octants of each element. Valid as long as this. */
    std::vector<FetchBuffer> buffers() const;
    /** A word for each element: the root of its hierarchy, or what the kernel says. */
    const Buffer& roots() const { return m_roots; }
    /** How many elements were asked for, then these. */
    const Buffer& asked() const { return m_asked; }

private:
    void clear();
    std::vector<std::uint32_t> divide(std::span<const std::uint32_t> elements) const;
    std::vector<std::uint32_t> evaluate(std::span<const std::uint32_t> elements_and_codes) const;
    void add_element(std::uint32_t element, std::span<const std::uint32_t> words);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    const ClassInfo& m_info;
    RecordBuffer m_octants, m_nodes;
    Buffer m_roots, m_asked;
    ComposedKernel m_kernel;
    std::uint64_t m_geometry_version;
    std::uint64_t m_n_octants = 0, m_n_nodes = 0;
    bool m_is_full = false;
};

} // namespace elvis
