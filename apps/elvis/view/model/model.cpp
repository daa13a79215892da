#include "model.hpp"

#include <core/scene/resolve.hpp>

#include <utility>

namespace elvis::view {

namespace {

std::vector<CutPlane> planes_of(const Scene& scene) {
    std::vector<CutPlane> planes;
    for (const SceneSurface& surface : scene.surfaces) {
        if (const CutPlane* const plane = traits_of(surface.geometry).plane; plane != nullptr && surface.is_shown) {
            planes.push_back(*plane);
        }
    }
    return planes.size() == scene.surfaces.size() ? planes : std::vector<CutPlane>{};
}

} // namespace

void Model::open(Scene scene, VolumeFacts facts, std::string file) {
    m_scene = std::move(scene);
    m_volume = std::move(facts);
    m_file = std::move(file);
    m_undo.clear();
    m_redo.clear();
    m_gesture.clear();
    m_selection = items_of(m_scene).empty() ? std::nullopt : std::optional(items_of(m_scene).front());
    const std::vector<CutPlane> planes = m_volume->dimension == 2 ? plane_of_flat(m_volume->bounds) : planes_of(m_scene);
    set_camera(resolve_camera(m_scene, m_volume->extent(), planes));
    m_is_changed = false;
}

void Model::saved(std::string file) {
    m_file = std::move(file);
    m_is_changed = false;
}

void Model::changed() {
    ++m_revision;
    m_is_changed = true;
}

void Model::edit(const std::string& what, Scene&& scene) {
    if (m_gesture != what || m_undo.empty()) {
        m_undo.push_back({what, m_scene, m_selection});
        if (m_undo.size() > most_steps) {
            m_undo.erase(m_undo.begin());
        }
    }
    m_gesture = what;
    m_redo.clear();
    m_scene = std::move(scene);
    changed();
}

void Model::set_camera(const Camera& camera) {
    elvis::set_camera(m_scene.camera, camera);
    ++m_revision;
}

void Model::set_size(const std::array<std::uint32_t, 2>& size) {
    if (m_scene.size != size) {
        m_scene.size = size;
        ++m_revision;
    }
}

Camera camera_of(const SceneCamera& own) {
    Camera camera;
    camera.orthographic = own.orthographic.value_or(false);
    camera.eye = own.eye.value_or(Vector3{0, 0, 1});
    camera.look_at = own.look_at.value_or(Vector3{});
    camera.up = own.up.value_or(Vector3{0, 1, 0});
    camera.field_of_view = own.field_of_view.value_or(camera.field_of_view);
    camera.height = own.height.value_or(camera.height);
    camera.image_shift = own.image_shift;
    return camera;
}

Camera Model::camera() const { return camera_of(m_scene.camera); }

std::optional<std::string> Model::undo_name() const {
    return m_undo.empty() ? std::nullopt : std::optional(m_undo.back().what);
}

std::optional<std::string> Model::redo_name() const {
    return m_redo.empty() ? std::nullopt : std::optional(m_redo.back().what);
}

void Model::exchange(std::vector<Step>& from, std::vector<Step>& to) {
    if (from.empty()) {
        return;
    }
    Step step = std::move(from.back());
    from.pop_back();
    step.scene.camera = m_scene.camera;
    step.scene.size = m_scene.size;
    to.push_back({step.what, std::exchange(m_scene, std::move(step.scene)), std::exchange(m_selection, step.selection)});
    m_gesture.clear();
    changed();
}

void Model::keep_steps(std::size_t most) {
    for (std::vector<Step>* steps : {&m_undo, &m_redo}) {
        if (steps->size() > most) {
            steps->erase(steps->begin(), steps->end() - static_cast<std::ptrdiff_t>(most));
        }
    }
}

void Model::undo() { exchange(m_undo, m_redo); }
void Model::redo() { exchange(m_redo, m_undo); }

std::optional<ItemId> Model::selection() const {
    return m_selection && exists(m_scene, *m_selection) ? m_selection : std::nullopt;
}

} // namespace elvis::view
