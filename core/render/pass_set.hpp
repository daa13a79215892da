/**
 * @file pass_set.hpp
 * The passes that draw one volume, by the field that they show, and the sets of faces, edges and solvers that they share: kept
 * as long as frames may need them again.
 */
#pragma once

#include <core/render/cut_surface/surface_solver.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/render/field/values_by_place.hpp>
#include <core/render/field_passes.hpp>
#include <core/render/frame.hpp>
#include <core/volume/boundary/edge_set.hpp>
#include <core/volume/boundary/face_set.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

class PassSet {
public:
    /** All must outlive it. `control` may be null. */
    PassSet(const Device& device, const RuntimeVolume& volume, DeviceVolume& data, VolumeRanges& ranges,
            const TaskControl* control)
        : m_device(device), m_volume(volume), m_data(data), m_ranges(ranges), m_control(control) {}

    /** Drops what the frame does not need. */
    void keep(const FrameRequest& request);

    /** Values of fields have changed: what rests on them goes. */
    void forget_fields() { m_passes.clear(); }

    /** Those that show the field at the time step of the frame, which keep() was told of. */
    FieldPasses& of(const FieldChoice& field);
    /** Of the shape that the elements have at the time step of the field that is on the device. */
    const FaceSet& faces(const FaceGeometry& faces);
    const EdgeSet& edges(const WireFrame& wires);
    SurfaceSolver& solver(const CutShape& shape);
    ValuesByPlace& by_place() { return m_by_place ? *m_by_place : m_by_place.emplace(m_device, m_volume); }

private:
    void keep_faces(const FrameRequest& request);
    void drop_faces(const std::function<bool(const FaceGeometry&)>& is_dropped);
    void follow_geometry();
    std::vector<ElementFace> chosen_faces(const FaceGeometry& faces) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    VolumeRanges& m_ranges;
    const TaskControl* m_control;
    /** Of the geometry that has this version. */
    std::map<FaceGeometry, FaceSet> m_face_sets;
    /** With whether they are undeformed. */
    std::map<std::pair<FaceGeometry, bool>, EdgeSet> m_edge_sets;
    std::uint64_t m_faces_version = 0;
    /** By ShownFields::key(): of the last frame, and of its time step. */
    std::map<std::string, FieldPasses> m_passes;
    std::uint32_t m_step = 0;
    std::optional<ValuesByPlace> m_by_place;
    /** By solver_key(). */
    std::map<std::string, SurfaceSolver> m_solvers;
};

} // namespace elvis
