/**
 * @file device_volume.hpp
 * A volume's data on the device: the plugin's buffers for some fields at a time step, and a hierarchy for each element class.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/glsl.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/element/curvature_records.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** A field as it is wanted on the device: less `offset`, one number a component, where the snippets can do so. */
struct FieldSlot {
    std::uint32_t field = 0;
    std::vector<double> offset;

    bool operator==(const FieldSlot&) const = default;
};

/** What is to be shown: one field, or an expression over several. */
struct FieldSelection {
    /** At least one. Of an expression, its fields in their order; any field if it has none. */
    std::vector<FieldSlot> slots;
    std::uint32_t time_step = 0;
    std::shared_ptr<const Expression> expression;
    /** In place of the field: the function that cuts elements (shaders/field/own_boundary.glsl). */
    bool is_own_boundary = false;
};

/** What an expression takes, with fields as they are. */
FieldSelection selection_of(const std::shared_ptr<const Expression>& expression, const RuntimeVolume& volume,
                            std::uint32_t time_step);

class DeviceVolume {
public:
    /**
     * Reads bounds and numbers, builds and uploads hierarchies and element origins. Device and volume must outlive it. Of a
     * part of a volume, bounds_of_whole: bounds() and all that is relative to them are those of the whole.
     */
    DeviceVolume(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control,
                 const std::optional<std::array<double, 6>>& bounds_of_whole = {});

    const std::array<double, 6>& bounds() const { return m_bounds; }
    /** Of each element, six numbers, until something is first selected; then none. */
    const std::vector<double>& boxes() const { return m_boxes; }
    /** What the hierarchies' bounds are relative to; exact in single precision. */
    const Vector3& centre() const { return m_centre; }
    Precision precision() const { return m_precision; }
    /** What the snippet's positions in an element are relative to; zero where they are the world's. */
    Vector3 origin(std::uint64_t element) const;
    /** Elements overlap: a point may lie in several of them. Kernels that are composed afterwards look for all. */
    void expect_overlaps() { m_has_overlaps = true; }
    bool has_overlaps() const { return m_has_overlaps; }
    /** Elements do not overlap, of the shape in which the plugin maps them. Before something is first selected. */
    void exclude_overlaps();
    /** Over this length at most elements may overlap: that of the largest one, because smaller overlaps may lie between samples
     * (core/probe/overlaps.hpp); the largest float where nothing is known. */
    float overlap_length() const;
    /** Changes whenever select() has given the elements another shape. */
    std::uint64_t geometry_version() const { return m_geometry_version; }

    /**
     * Makes a choice current: fills what it needs and is not there yet. What other choices need stays, until keep() drops it,
     * and so do kernels composed with it.
     */
    void select(const FieldSelection& selection);
    /** Values of a field have changed, or of all: the next selection fills its buffers anew. */
    void forget_fields(std::optional<std::uint32_t> only = {});
    /** Drops what none of these needs. */
    void keep(std::span<const FieldSelection> selections);
    /**
     * One field alone, and no other. It lacks `offset` (one number a component) on the device, if the snippets can do so:
     * field_offset() tells what was subtracted.
     */
    void select(std::uint32_t field, std::uint32_t time_step, const std::vector<double>& offset);
    /** Of the first field. */
    double field_offset(std::uint32_t component) const { return slot(0).offset[component]; }

    /** The class's snippet with field `index` of the selected ones; valid as long as the field is kept. */
    SnippetInstance instance(std::uint32_t element_class, std::size_t index = 0) const;
    /** What text of the selected expression is to be written for. */
    ExpressionClass about_class(std::uint32_t element_class) const;
    /**
     * What a kernel needs to show what is selected: instances, with bounds of derivatives if they are wanted (see below), and
     * for an expression its functions (core/expression/glsl.hpp), of which core_shown_model comes with the bounds.
     */
    void add_field(KernelRequest& request, std::uint32_t element_class, bool with_bounds = false) const;

    /** `core_elements`: number and linearized inverse mapping of the class's elements (shaders/element/linearization.glsl). */
    FetchBuffer elements(std::uint32_t element_class) const;
    /** Of the class's elements, once a field is selected. */
    const CurvatureRecords& curvature_records(std::uint32_t element_class) const {
        return m_classes[element_class].curvature_records;
    }
    /** Nodes of the class's hierarchy as `core_nodes`, and its elements. */
    std::vector<FetchBuffer> host_buffers(std::uint32_t element_class) const;
    /** Of the class's elements. */
    const Hierarchy& hierarchy(std::uint32_t element_class) const { return m_classes[element_class].hierarchy; }
    /** Of the mapping of each element of the class (shaders/element/prediction.glsl), once a field is selected. */
    std::span<const float> curvatures(std::uint32_t element_class) const { return m_classes[element_class].curvatures; }

    /** CORE_STRONGLY_BENT: "1" if the class has elements in which what is measured of curvatures may be too little. */
    std::pair<std::string, std::string> strongly_bent_define(std::uint32_t element_class) const;

    /**
     * Makes bounds of the selected fields and their derivatives in every element, if they are not there yet. For kernels that
     * need them; select() comes first.
     */
    void provide_derivative_bounds();
    /**
     * `core_bounds` (of field `index` > 0 core_bounds_1 and so on): elvis_fetch4_core_bounds(element, component) = (H, L, F,
     * certainty), see derivative_bounds.hpp. Needs provide_derivative_bounds(); valid as long as field and time step are kept.
     */
    FetchBuffer derivative_bounds(std::uint32_t element_class, std::size_t index = 0) const;

    std::uint64_t field_bytes() const;
    std::uint64_t geometry_bytes() const;
    std::uint64_t hierarchy_bytes() const;
    double upload_milliseconds() const { return m_upload_milliseconds; }
    double hierarchy_milliseconds() const { return m_hierarchy_milliseconds; }

private:
    struct PluginBuffer {
        BufferInfo info;
        std::unique_ptr<RecordBuffer> records;
        /** Whether all of it is there: filling may have been cancelled. */
        bool is_filled = false;
        std::uint32_t time_step = 0;
    };
    /** A field on the device. */
    struct Slot {
        std::uint32_t field = 0;
        std::vector<double> offset;
        /** By the plugin's buffers; empty where one does not depend on the field. */
        std::vector<PluginBuffer> buffers;
        /** By class; null until they are wanted. */
        std::vector<std::unique_ptr<RecordBuffer>> derivative_bounds;
        std::uint32_t bounds_time_step = 0;
    };
    struct ClassData {
        Snippet snippet;
        Hierarchy hierarchy;
        std::unique_ptr<RecordBuffer> nodes;
        std::unique_ptr<RecordBuffer> origins;
        std::unique_ptr<RecordBuffer> elements;
        std::vector<float> curvatures;
        CurvatureRecords curvature_records;
    };

    void read_bounds(const std::optional<std::array<double, 6>>& bounds_of_whole);
    void build_class(std::uint32_t element_class);
    void write_elements();
    bool provide(const FieldSlot& wanted, Slot& slot);
    bool provide(std::uint32_t index, const Slot& slot, PluginBuffer& buffer);
    void fill(std::uint32_t index, const Slot& slot, PluginBuffer& buffer);
    std::vector<double> possible_offset(const std::vector<double>& offset) const;
    bool is_slot(const Slot& slot, const FieldSlot& wanted) const;
    const Slot& slot(std::size_t index) const { return *m_selected[index]; }
    bool has_capability(std::uint32_t element_class, std::uint32_t capability) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    Precision m_precision;
    const TaskControl* m_control;
    std::array<double, 6> m_bounds{};
    std::vector<double> m_boxes;
    Vector3 m_centre{};
    /** Three numbers an element, exact in single precision. */
    std::vector<double> m_origins;
    std::vector<ClassData> m_classes;
    /** By the plugin's buffers; empty where one depends on the field. */
    std::vector<PluginBuffer> m_buffers;
    std::vector<std::unique_ptr<Slot>> m_slots;
    /** Among m_slots, in the order of the selection. */
    std::vector<Slot*> m_selected;
    std::shared_ptr<const Expression> m_expression;
    bool m_is_own_boundary = false;
    std::uint32_t m_time_step = 0;
    bool m_has_elements = false;
    bool m_has_overlaps = false;
    std::optional<float> m_overlap_length;
    std::uint64_t m_geometry_version = 0;
    double m_upload_milliseconds = 0;
    double m_hierarchy_milliseconds = 0;
};

} // namespace elvis
