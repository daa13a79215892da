/**
 * @file model.hpp
 * The state of the window that does not depend on there being a window: the scene, what is selected, undo and redo.
 */
#pragma once

#include "volume_facts.hpp"
#include <apps/elvis/view/scene/items.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/**
 * Changes are whole scenes. Those that belong to one gesture (a drag, a text being typed) and have the same name are one step
 * of undo. Camera and size of the picture are no steps: undo leaves them alone.
 */
class Model {
public:
    const Scene& scene() const { return m_scene; }
    /** Of the open volume, if there is one. */
    const std::optional<VolumeFacts>& volume() const { return m_volume; }
    /** Where the scene is kept; empty if it is not. */
    const std::string& file() const { return m_file; }
    /** There is something to save, besides the camera. */
    bool is_changed() const { return m_is_changed; }
    /** Grows with everything that changes the picture. */
    std::uint64_t revision() const { return m_revision; }

    /** A scene whose camera is complete, and its volume; nothing of what was before stays. */
    void open(Scene scene, VolumeFacts facts, std::string file);
    void saved(std::string file);

    /** `what` names the step: "opacity", "remove plane". */
    void edit(const std::string& what, Scene&& scene);
    /** What follows is a step of its own. */
    void end_gesture() { m_gesture.clear(); }
    /** An edit has been made since the last end_gesture(). */
    bool is_in_gesture() const { return !m_gesture.empty(); }

    void set_camera(const Camera& camera);
    void set_size(const std::array<std::uint32_t, 2>& size);
    /** The scene with camera and size of this one. */
    Scene as_seen(Scene scene) const;
    Camera camera() const { return camera_of(part_of(m_scene, "camera")); }

    /** The name of the step that would be undone, or nothing. */
    std::optional<std::string> undo_name() const;
    std::optional<std::string> redo_name() const;
    void undo();
    /** Forgets all steps that can be undone or redone but the newest. */
    void keep_steps(std::size_t most);
    void redo();

    /** The item whose properties are shown; nothing if there is none. */
    std::optional<ItemId> selection() const;
    void select(std::optional<ItemId> item) { m_selection = item; }

private:
    struct Step {
        std::string what;
        Scene scene; ///< before the step if it can be undone, after it if it can be redone
        std::optional<ItemId> selection;
    };
    void exchange(std::vector<Step>& from, std::vector<Step>& to);
    void changed();

    Scene m_scene = scene_of_files({});
    std::optional<VolumeFacts> m_volume;
    std::string m_file;
    bool m_is_changed = false;
    std::uint64_t m_revision = 0;
    std::string m_gesture;
    std::vector<Step> m_undo, m_redo;
    std::optional<ItemId> m_selection;
};

/** Steps of undo that are kept. */
inline constexpr std::size_t most_steps = 200;

} // namespace elvis::view
