/**
 * @file device_volume.hpp
 * A volume's data on the device: the plugin's buffers for one field and time step, and a hierarchy for each element class.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace elvis {

class DeviceVolume {
public:
    /** Reads bounds and numbers, builds and uploads hierarchies and element origins. Device and volume must outlive it. */
    DeviceVolume(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control);

    const std::array<double, 6>& bounds() const { return m_bounds; }
    /** What the hierarchies' bounds are relative to; exact in single precision. */
    const std::array<double, 3>& centre() const { return m_centre; }
    Precision precision() const { return m_precision; }
    /** What the snippet's positions in an element are relative to; zero where they are the world's. */
    std::array<double, 3> origin(std::uint64_t element) const;
    /** Changes whenever select() has given the elements another shape. */
    std::uint64_t geometry_version() const { return m_geometry_version; }

    /**
     * Fills what depends on these and is not there yet. The field on the device lacks `offset` (one number a component), if the
     * snippets can do so: field_offset() tells what was subtracted. Invalidates kernels composed before where it returns true.
     */
    bool select(std::uint32_t field, std::uint32_t time_step, const std::vector<double>& offset);
    double field_offset(std::uint32_t component) const { return m_offset[component]; }

    /** The class's snippet with the selected field; valid until the next select(). */
    SnippetInstance instance(std::uint32_t element_class) const;
    /**
     * Nodes of the class's hierarchy as `core_nodes`, and as `core_elements` the number and linearized inverse mapping of its
     * elements (shaders/library/linearization.glsl).
     */
    std::vector<FetchBuffer> host_buffers(std::uint32_t element_class) const;

    /**
     * Makes bounds of the selected field and its derivatives in every element, if they are not there yet. For kernels that need
     * them; select() comes first.
     */
    void provide_derivative_bounds();
    /**
     * `core_bounds`: elvis_fetch4_core_bounds(element, component) = (H, L, F, certainty), see derivative_bounds.hpp. Needs
     * provide_derivative_bounds() after the latest select(); valid until select() chooses another field, time step or offset.
     */
    FetchBuffer derivative_bounds(std::uint32_t element_class) const;

    std::uint64_t field_bytes() const;
    std::uint64_t geometry_bytes() const;
    std::uint64_t hierarchy_bytes() const;
    double upload_milliseconds() const { return m_upload_milliseconds; }
    double hierarchy_milliseconds() const { return m_hierarchy_milliseconds; }

private:
    struct PluginBuffer {
        BufferInfo info;
        std::unique_ptr<RecordBuffer> records;
        std::uint32_t field = 0;
        std::uint32_t time_step = 0;
        std::vector<double> offset;
    };
    struct ClassData {
        Snippet snippet;
        std::unique_ptr<RecordBuffer> nodes;
        std::unique_ptr<RecordBuffer> origins;
        std::unique_ptr<RecordBuffer> elements;
        /** Of the selected field; null until they are wanted. */
        std::unique_ptr<RecordBuffer> derivative_bounds;
    };

    void read_bounds();
    void build_class(std::uint32_t element_class, const std::vector<double>& boxes);
    void fill(std::uint32_t index, PluginBuffer& buffer);
    bool has_capability(std::uint32_t element_class, std::uint32_t capability) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    Precision m_precision;
    const TaskControl* m_control;
    std::array<double, 6> m_bounds{};
    std::array<double, 3> m_centre{};
    /** Three numbers an element, exact in single precision. */
    std::vector<double> m_origins;
    std::vector<ClassData> m_classes;
    std::vector<PluginBuffer> m_buffers;
    std::vector<double> m_offset;
    std::uint32_t m_field = 0;
    std::uint32_t m_time_step = 0;
    bool m_has_elements = false;
    std::uint64_t m_geometry_version = 0;
    double m_upload_milliseconds = 0;
    double m_hierarchy_milliseconds = 0;
};

} // namespace elvis
