/**
 * @file pass_set.hpp
 * The passes that draw one volume, each made when it is first needed and kept as long as frames may need it again: to make one
 * takes compilations.
 */
#pragma once

#include <core/render/boundary/face_pass.hpp>
#include <core/render/cut_surface/cut_plane_pass.hpp>
#include <core/render/cut_surface/surface_pass.hpp>
#include <core/render/field/point_value_pass.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/render/isosurface/isosurface_pass.hpp>
#include <core/render/lines/edge_pass.hpp>
#include <core/render/lines/line_pass.hpp>
#include <core/render/renderer.hpp>
#include <core/render/volume/volume_pass.hpp>

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace elvis {

/** The geometries that are sets of faces. */
using FaceGeometry = std::variant<BoundaryFaces, FlatElements, ElementFaces>;

/** Nothing if the surface is no set of faces. */
std::optional<FaceGeometry> face_geometry(const Surface& surface);

/** Functions without a field are about the one selected last. */
class PassSet {
public:
    /** All must outlive it. `control` may be null. */
    PassSet(const Device& device, const RuntimeVolume& volume, DeviceVolume& data, ShownFields& fields,
            const TaskControl* control)
        : m_device(device), m_volume(volume), m_data(data), m_fields(fields), m_control(control) {}

    /** Drops what the frame does not need. */
    void keep(const FrameRequest& request);
    /** Uploads the field if it is not there. */
    void select(const FieldChoice& field, std::uint32_t time_step);

    /** Make what the surface, or the volume, needs, whose field is the selected one. */
    void provide(const FrameRequest& request, const Surface& surface);
    void provide_volume(const VolumeRendering& wanted);

    CutPlanePass& cut_planes(bool with_lines);
    FacePass& faces(const FaceGeometry& faces);
    SurfacePass& cut_shapes() { return *m_current->cut_shapes; }
    SurfaceSolver& solver(const CutShape& shape) { return m_solvers.at(solver_key(shape)); }
    /** Of surfaces other than planes. */
    LinePass& lines(const Surface& surface);
    /** Of any field that was provided. */
    IsosurfacePass& isosurfaces(const FieldChoice& field) { return *m_passes.at(ShownFields::key(field)).isosurfaces; }
    PointValuePass& point_values() { return *m_current->point_values; }
    VolumePass& volume() { return *m_current->volume; }
    /** Elements that are only parts of their reference shape. */
    std::uint64_t n_cut_elements() const;
    EdgePass& edge_pass();
    const EdgeSet& edges(const FaceGeometry& faces);

private:
    /** The passes that show one field. */
    struct FieldPasses {
        std::optional<CutPlanePass> cut_planes, cut_planes_with_lines;
        std::map<FaceGeometry, FacePass> faces;
        std::optional<SurfacePass> cut_shapes;
        std::map<FaceGeometry, LinePass> lines_on_faces;
        /** By SurfaceSolver::quadric_rows(). */
        std::map<std::uint32_t, LinePass> lines_on_shapes;
        std::optional<LinePass> lines_on_own_boundary;
        std::optional<IsosurfacePass> isosurfaces;
        std::optional<PointValuePass> point_values;
        std::optional<VolumePass> volume;
    };

    void follow_geometry();
    void keep_faces(const FrameRequest& request);
    const FaceSet& face_set(const FaceGeometry& faces);
    std::vector<ElementFace> chosen_faces(const FaceGeometry& faces) const;
    void provide_shape(const CutShape& shape);
    void provide_isosurfaces(const Isosurfaces& wanted);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    ShownFields& m_fields;
    const TaskControl* m_control;
    /** Of the geometry that has this version. */
    std::map<FaceGeometry, FaceSet> m_face_sets;
    std::map<FaceGeometry, EdgeSet> m_edge_sets;
    std::uint64_t m_faces_version = 0;
    std::optional<EdgePass> m_edge_pass;
    /** By what they show: ShownFields::key. Those of the last frame, and of its time step. */
    std::map<std::string, FieldPasses> m_passes;
    /** Of the selected field. */
    FieldPasses* m_current = nullptr;
    std::uint32_t m_step = 0;
    /** By solver_key(); of no field. */
    std::map<std::string, SurfaceSolver> m_solvers;
};

} // namespace elvis
