#include <core/render/pass_set.hpp>

#include <set>
#include <type_traits>

namespace elvis {

namespace {

/** Solvers kept for later frames: some hold large meshes. */
constexpr std::size_t most_solvers = 32;

/** Sets of faces kept for later frames: while a selection is edited, each frame brings another. */
constexpr std::size_t most_face_sets = 8;

} // namespace

std::optional<FaceGeometry> face_geometry(const Surface& surface) {
    return std::visit(
        [](const auto& geometry) -> std::optional<FaceGeometry> {
            if constexpr (std::is_constructible_v<FaceGeometry, decltype(geometry)>) {
                return geometry;
            } else {
                return std::nullopt;
            }
        },
        surface.geometry);
}

void PassSet::keep(const FrameRequest& request) {
    std::vector<FieldSelection> selections;
    std::set<std::string> keys;
    const auto keep_field = [&](const FieldChoice& field) {
        selections.push_back(m_fields.selection(field, request.time_step));
        keys.insert(ShownFields::key(field));
    };
    for (const Surface& surface : request.surfaces) {
        keep_field(surface.field);
        if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
            keep_field(isosurfaces->field);
        }
    }
    if (request.volume) {
        keep_field(request.volume->field);
    }
    // Bounds of derivatives, on which passes rest, are made anew for another step.
    const bool is_other_step = m_step != request.time_step;
    std::erase_if(m_passes, [&](const auto& entry) { return is_other_step || !keys.contains(entry.first); });
    keep_faces(request);
    m_data.keep(selections);
    m_step = request.time_step;
    m_current = nullptr;
}

/** Drops sets of faces that the frame does not show once there are many, and what was made for them. */
void PassSet::keep_faces(const FrameRequest& request) {
    if (m_face_sets.size() <= most_face_sets && m_edge_sets.size() <= most_face_sets) {
        return;
    }
    std::set<FaceGeometry> shown;
    for (const Surface& surface : request.surfaces) {
        if (const auto* wires = std::get_if<WireFrame>(&surface.geometry)) {
            shown.insert(wires->faces);
        } else if (const std::optional<FaceGeometry> faces = face_geometry(surface)) {
            shown.insert(*faces);
        }
    }
    const auto is_hidden = [&](const auto& entry) { return !shown.contains(entry.first); };
    for (auto& [key, of_field] : m_passes) {
        std::erase_if(of_field.faces, is_hidden);
        std::erase_if(of_field.lines_on_faces, is_hidden);
    }
    std::erase_if(m_face_sets, is_hidden);
    std::erase_if(m_edge_sets, is_hidden);
}

void PassSet::select(const FieldChoice& field, std::uint32_t time_step) {
    m_data.select(m_fields.selection(field, time_step));
    m_current = &m_passes[ShownFields::key(field)];
}

void PassSet::provide(const FrameRequest& request, const Surface& surface) {
    if (std::holds_alternative<CutPlane>(surface.geometry)) {
        cut_planes(surface.has_lines());
        return;
    }
    if (const auto* wires = std::get_if<WireFrame>(&surface.geometry)) {
        edges(wires->faces);
        return;
    }
    if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        provide_shape(*shape);
    } else if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        if (surface.field != isosurfaces->field && !m_current->point_values) {
            m_current->point_values.emplace(m_device, m_volume, m_data);
        }
        select(isosurfaces->field, request.time_step);
        provide_isosurfaces(*isosurfaces);
        select(surface.field, request.time_step);
    } else {
        faces(*face_geometry(surface));
    }
    if (surface.has_lines()) {
        lines(surface).provide(surface.contours && !surface.contours->values.empty());
    }
}

void PassSet::provide_shape(const CutShape& shape) {
    if (!m_current->cut_shapes) {
        m_current->cut_shapes.emplace(m_device, m_volume, m_data);
    }
    const std::string key = solver_key(shape);
    if (m_solvers.size() >= most_solvers && !m_solvers.contains(key)) {
        m_solvers.clear();
    }
    m_solvers.try_emplace(key, m_device, m_data.precision(), shape);
}

void PassSet::provide_isosurfaces(const Isosurfaces& wanted) {
    if (!m_current->isosurfaces) {
        m_data.provide_derivative_bounds();
        m_current->isosurfaces.emplace(m_device, m_volume, m_data);
    }
    m_current->isosurfaces->choose(wanted, m_fields.offset(wanted.field), m_fields.component(wanted.field));
}

void PassSet::provide_volume(const VolumeRendering& wanted) {
    if (!m_current->volume) {
        m_data.provide_derivative_bounds();
        m_current->volume.emplace(m_device, m_volume, m_data);
    }
    m_current->volume->choose(wanted, m_fields.offset(wanted.field), m_fields.component(wanted.field));
}

CutPlanePass& PassSet::cut_planes(bool with_lines) {
    std::optional<CutPlanePass>& pass = with_lines ? m_current->cut_planes_with_lines : m_current->cut_planes;
    if (!pass) {
        if (with_lines) {
            m_data.provide_derivative_bounds();
        }
        pass.emplace(m_device, m_volume, m_data, with_lines);
    }
    return *pass;
}

LinePass& PassSet::lines(const Surface& surface) {
    m_data.provide_derivative_bounds();
    if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        const std::uint32_t rows = solver(*shape).quadric_rows();
        return m_current->lines_on_shapes.try_emplace(rows, m_device, m_volume, m_data, nullptr, false, rows).first->second;
    }
    if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        if (isosurfaces->field.is_own_boundary) {
            if (!m_current->lines_on_own_boundary) {
                m_current->lines_on_own_boundary.emplace(m_device, m_volume, m_data, nullptr, false, 0, true);
            }
            return *m_current->lines_on_own_boundary;
        }
        return m_current->lines_on_shapes.try_emplace(0, m_device, m_volume, m_data, nullptr, false, 0).first->second;
    }
    follow_geometry();
    const FaceGeometry on = *face_geometry(surface);
    const auto* boundary = std::get_if<BoundaryFaces>(&on);
    // Where elements are cut, rays pass between faces and what the cut leaves out.
    const bool is_whole_boundary = boundary != nullptr && boundary->groups.empty() && n_cut_elements() == 0;
    return m_current->lines_on_faces.try_emplace(on, m_device, m_volume, m_data, &face_set(on), is_whole_boundary, 0)
        .first->second;
}

std::uint64_t PassSet::n_cut_elements() const {
    std::uint64_t count = 0;
    for (std::uint32_t index = 0; index < m_volume.classes().size(); ++index) {
        count += m_volume.is_cut(index) ? m_volume.classes()[index].n_elements : 0;
    }
    return count;
}

EdgePass& PassSet::edge_pass() {
    if (!m_edge_pass) {
        m_edge_pass.emplace(m_data.precision());
    }
    return *m_edge_pass;
}

/** Drops what belongs to another shape of the elements. */
void PassSet::follow_geometry() {
    if (m_data.geometry_version() != m_faces_version) {
        for (auto& [key, of_field] : m_passes) {
            of_field.faces.clear();
            of_field.lines_on_faces.clear();
        }
        m_face_sets.clear();
        m_edge_sets.clear();
        m_faces_version = m_data.geometry_version();
    }
}

const EdgeSet& PassSet::edges(const FaceGeometry& faces) {
    follow_geometry();
    auto found = m_edge_sets.find(faces);
    if (found == m_edge_sets.end()) {
        found = m_edge_sets.try_emplace(faces, m_device, m_volume, m_data, chosen_faces(faces), m_control).first;
    }
    return found->second;
}

const FaceSet& PassSet::face_set(const FaceGeometry& faces) {
    auto found = m_face_sets.find(faces);
    if (found == m_face_sets.end()) {
        found = m_face_sets.try_emplace(faces, m_device, m_volume, m_data, chosen_faces(faces), m_control).first;
    }
    return found->second;
}

FacePass& PassSet::faces(const FaceGeometry& faces) {
    follow_geometry();
    auto found = m_current->faces.find(faces);
    if (found == m_current->faces.end()) {
        found = m_current->faces.try_emplace(faces, m_device, m_volume, m_data, face_set(faces)).first;
    }
    return found->second;
}

std::vector<ElementFace> PassSet::chosen_faces(const FaceGeometry& faces) const {
    if (const auto* boundary = std::get_if<BoundaryFaces>(&faces)) {
        return boundary_faces(m_volume, boundary->groups, m_control);
    }
    if (const auto* elements = std::get_if<ElementFaces>(&faces)) {
        return faces_of_elements(m_volume, elements->selection, m_control);
    }
    return surface_elements(m_volume);
}

} // namespace elvis
