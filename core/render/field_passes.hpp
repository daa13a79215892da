/**
 * @file field_passes.hpp
 * The passes that show one field of one volume.
 */
#pragma once

#include <core/render/boundary/face_pass.hpp>
#include <core/render/cut_surface/cut_plane_pass.hpp>
#include <core/render/cut_surface/surface_pass.hpp>
#include <core/render/field/point_value_pass.hpp>
#include <core/render/isosurface/isosurface_pass.hpp>
#include <core/render/lines/line_pass.hpp>
#include <core/render/volume/volume_pass.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace elvis {

/** Each is made when it is first asked for, which takes compilations. While passes compile, `data` has their field selected. */
class FieldPasses {
public:
    /** All must outlive it. */
    FieldPasses(const Device& device, const RuntimeVolume& volume, DeviceVolume& data, FieldSelection field)
        : m_device(device), m_volume(volume), m_data(data), m_field(std::move(field)) {}

    CutPlanePass& cut_planes(bool with_lines) {
        return made(with_lines ? m_cut_planes_with_lines : m_cut_planes, with_lines, with_lines);
    }
    SurfacePass& cut_shapes() { return made(m_cut_shapes, false); }
    PointValuePass& point_values() { return made(m_point_values, false); }
    IsosurfacePass& isosurfaces() { return made(m_isosurfaces, true); }
    VolumePass& volume() { return made(m_volume_rendering, true); }
    /** `faces` must outlive it, or be dropped. */
    FacePass& faces(const FaceSet& faces) { return made(m_faces[&faces], false, faces); }
    /** `is_whole_boundary`: see LinePass. */
    LinePass& lines_on_faces(const FaceSet& faces, bool is_whole_boundary) {
        return made(m_lines_on_faces[&faces], true, &faces, is_whole_boundary, 0u);
    }
    /** Of a solver with so many SurfaceSolver::quadric_rows(). */
    LinePass& lines_on_shapes(std::uint32_t quadric_rows) {
        return made(m_lines_on_shapes[quadric_rows], true, nullptr, false, quadric_rows);
    }
    LinePass& lines_on_own_boundary() { return made(m_lines_on_own_boundary, true, nullptr, false, 0u, true); }

    /** What was made for these faces. */
    void drop(const FaceSet& faces) {
        m_faces.erase(&faces);
        m_lines_on_faces.erase(&faces);
    }

private:
    template <class Pass, class... Choices>
    Pass& made(std::optional<Pass>& pass, bool with_derivative_bounds, const Choices&... choices) {
        m_data.select(m_field);
        if (with_derivative_bounds) {
            m_data.provide_derivative_bounds();
        }
        return pass ? *pass : pass.emplace(m_device, m_volume, m_data, choices...);
    }

    const Device& m_device;
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    FieldSelection m_field;
    std::optional<CutPlanePass> m_cut_planes, m_cut_planes_with_lines;
    std::optional<SurfacePass> m_cut_shapes;
    std::optional<PointValuePass> m_point_values;
    std::optional<IsosurfacePass> m_isosurfaces;
    std::optional<VolumePass> m_volume_rendering;
    std::map<const FaceSet*, std::optional<FacePass>> m_faces;
    std::map<const FaceSet*, std::optional<LinePass>> m_lines_on_faces;
    std::map<std::uint32_t, std::optional<LinePass>> m_lines_on_shapes;
    std::optional<LinePass> m_lines_on_own_boundary;
};

} // namespace elvis
