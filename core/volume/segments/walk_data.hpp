/**
 * @file walk_data.hpp
 * How rays go from element to element through shared faces, and where they can come in.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** A point, and in a parallel view the plane across it that all rays begin in. */
struct ViewStart {
    Vector3 eye{};
    /** Of unit length; none of a perspective view. */
    std::optional<Vector3> direction;

    bool operator==(const ViewStart&) const = default;
};

class WalkData {
public:
    /** `data` has curvatures: a field has been selected. Both must outlive it. */
    WalkData(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Elements in which rays can start: those with a face without known neighbour or a boundary of
     * their own, and those that may hold the start of a ray. */
    void look_from(const ViewStart& start);
    /** Rays may start in any element. */
    void look_from_anywhere();
    /**
     * Rays go as if the other elements were not there; look_from() comes after it. One flag an element, by class; of no class:
     * all are there.
     */
    void keep_only(std::vector<std::vector<bool>> kept);

    /**
     * `core_nodes`, a hierarchy over those in which leaves are local elements; and `core_links`: for each local face of an
     * element the neighbour among all elements of the volume, all bits where none is known, and at place 7 the bits of the
     * mapping's curvature. Where rays have to be followed in elements of the class, `core_cones`, too: the directions of their
     * faces. Valid as long as this. Of classes with elements.
     */
    std::vector<FetchBuffer> host_buffers(std::uint32_t element_class) const;
    /** CORE_HAS_CURVED for kernels on the class's elements: whether rays have to be followed in any of them
     * (shaders/segments/segment.glsl). */
    std::pair<std::string, std::string> curved_define(std::uint32_t element_class) const;
    std::uint64_t n_starts(std::uint32_t element_class) const { return m_classes[element_class].n_starts; }
    /** Whether an eye may lie in one of the class's elements. */
    bool may_hold_eye(std::uint32_t element_class) const { return m_classes[element_class].may_hold_eye; }

private:
    struct ClassWalk {
        std::unique_ptr<RecordBuffer> nodes, links, cones;
        std::vector<bool> is_kept, is_open;
        std::uint64_t n_starts = 0;
        bool may_hold_eye = false;
        /** Six numbers an element. */
        std::vector<double> boxes;
    };

    template <class CanStart> void choose_starts(const CanStart& can_start);
    bool is_kept(std::uint32_t element) const;
    bool has_curved(std::uint32_t element_class) const;

    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    Vector3 m_centre;
    std::vector<ClassWalk> m_classes;
    std::optional<ViewStart> m_start;
    bool m_is_anywhere = false;
};

} // namespace elvis
