#include "model.hpp"

#include <utility>

namespace elvis::view {

void Model::open(Scene scene, VolumeFacts facts, std::string file) {
    m_scene = std::move(scene);
    m_volume = std::move(facts);
    m_file = std::move(file);
    m_undo.clear();
    m_redo.clear();
    m_gesture.clear();
    m_selection = items_of(m_scene).empty() ? std::nullopt : std::optional(items_of(m_scene).front());
    ++m_revision;
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
    say_camera(m_scene["camera"], camera);
    ++m_revision;
}

void Model::set_size(const std::array<std::uint32_t, 2>& size) {
    if (size_of(m_scene) != size) {
        m_scene["image"]["size"] = size;
        ++m_revision;
    }
}

Scene Model::as_seen(Scene scene) const {
    scene["camera"] = m_scene.at("camera");
    scene["image"]["size"] = m_scene.at("image").at("size");
    return scene;
}

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
    to.push_back(
        {step.what, std::exchange(m_scene, as_seen(std::move(step.scene))), std::exchange(m_selection, step.selection)});
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
