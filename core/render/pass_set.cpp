#include <core/base/overloaded.hpp>
#include <core/render/pass_set.hpp>

#include <algorithm>
#include <optional>
#include <set>

namespace elvis {

namespace {

/** Solvers kept for later frames: some hold large meshes. */
constexpr std::size_t most_solvers = 32;

/** Sets of faces kept for later frames: while a selection is edited, each frame brings another. */
constexpr std::size_t most_face_sets = 8;

/** The faces that a surface shows, or whose edges. */
struct FacesOfKind {
    using Faces = std::optional<FaceGeometry>;
    Faces operator()(const FaceGeometry& faces) const { return faces; }
    Faces operator()(const WireFrame& wires) const { return wires.faces; }
    Faces operator()(const CutPlane&) const { return {}; }
    Faces operator()(const CutShape&) const { return {}; }
    Faces operator()(const Isosurfaces&) const { return {}; }
};

} // namespace

void PassSet::keep(const FrameRequest& request) {
    std::vector<FieldSelection> selections;
    std::set<std::string> keys;
    const auto keep_field = [&](const FieldChoice& field) {
        selections.push_back(m_ranges.selection(field, request.time_step));
        keys.insert(ShownFields::key(field));
    };
    for (const Surface& surface : request.surfaces) {
        keep_field(surface.field);
        if (const Isosurfaces* isosurfaces = traits_of(surface.geometry).isosurfaces) {
            keep_field(isosurfaces->field);
        }
        for (const Condition& condition : surface.conditions) {
            keep_field(condition.field);
        }
        if (surface.lic) {
            std::ranges::for_each(surface.lic->vectors, keep_field);
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
}

/** Drops sets of faces that the frame does not show, once there are many. */
void PassSet::keep_faces(const FrameRequest& request) {
    if (m_face_sets.size() <= most_face_sets && m_edge_sets.size() <= most_face_sets) {
        return;
    }
    std::set<FaceGeometry> shown;
    for (const Surface& surface : request.surfaces) {
        if (std::optional<FaceGeometry> faces = std::visit(FacesOfKind(), surface.geometry)) {
            shown.insert(std::move(*faces));
        }
    }
    drop_faces([&](const FaceGeometry& faces) { return !shown.contains(faces); });
}

/** With what was made for them. */
void PassSet::drop_faces(const std::function<bool(const FaceGeometry&)>& is_dropped) {
    for (auto& [key, passes] : m_passes) {
        for (const auto& [faces, set] : m_face_sets) {
            if (is_dropped(faces)) {
                passes.drop(set);
            }
        }
    }
    std::erase_if(m_face_sets, [&](const auto& entry) { return is_dropped(entry.first); });
    std::erase_if(m_edge_sets, [&](const auto& entry) { return is_dropped(entry.first.first); });
}

/** Drops what belongs to another shape of the elements. */
void PassSet::follow_geometry() {
    if (m_data.geometry_version() != m_faces_version) {
        drop_faces([](const FaceGeometry&) { return true; });
        m_faces_version = m_data.geometry_version();
    }
}

FieldPasses& PassSet::of(const FieldChoice& field) {
    return m_passes.try_emplace(ShownFields::key(field), m_device, m_volume, m_data, m_ranges.selection(field, m_step))
        .first->second;
}

SurfaceSolver& PassSet::solver(const CutShape& shape) {
    const std::string key = solver_key(shape);
    if (m_solvers.size() >= most_solvers && !m_solvers.contains(key)) {
        m_solvers.clear();
    }
    return m_solvers.try_emplace(key, m_device, m_data.precision(), shape, m_data.bounds()).first->second;
}

const EdgeSet& PassSet::edges(const WireFrame& wires) {
    follow_geometry();
    const RuntimeVolume* const undeformed = wires.is_undeformed ? m_volume.undeformed() : nullptr;
    const std::pair key(wires.faces, undeformed != nullptr);
    auto found = m_edge_sets.find(key);
    if (found == m_edge_sets.end()) {
        const std::vector<ElementFace> faces = chosen_faces(wires.faces);
        found = m_edge_sets
                    .emplace(key, undeformed != nullptr ? EdgeSet(*undeformed, faces, m_control)
                                                        : EdgeSet(m_device, m_volume, m_data, faces, m_control))
                    .first;
    }
    return found->second;
}

const FaceSet& PassSet::faces(const FaceGeometry& faces) {
    follow_geometry();
    auto found = m_face_sets.find(faces);
    if (found == m_face_sets.end()) {
        found = m_face_sets.try_emplace(faces, m_device, m_volume, m_data, chosen_faces(faces), m_control).first;
    }
    return found->second;
}

std::vector<ElementFace> PassSet::chosen_faces(const FaceGeometry& faces) const {
    return std::visit(
        Overloaded{[&](const BoundaryFaces& boundary) { return boundary_faces(m_volume, boundary.groups, m_control); },
                   [&](const FlatElements&) { return surface_elements(m_volume); },
                   [&](const ElementFaces& elements) { return faces_of_elements(m_volume, elements.selection, m_control); }},
        faces);
}

} // namespace elvis
