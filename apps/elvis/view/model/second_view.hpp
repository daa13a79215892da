/**
 * @file second_view.hpp
 * A second view of the volume beside the first: with its own camera, unless both are linked, and its own choice of items.
 */
#pragma once

#include "model.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** What it shows is the model's scene, but for camera, size, and which items are shown. It is no part of a scene file. */
class SecondView {
public:
    bool is_on() const { return m_is_on; }
    /** It begins as the first view is. */
    void turn_on(const Model& model);
    void turn_off() { m_is_on = false; }

    bool is_linked() const { return m_is_linked; }
    /** Linked, it has the first view's camera; no longer linked, the one that it has then. */
    void set_linked(const Model& model, bool is_linked);
    Camera camera(const Model& model) const { return m_is_linked ? model.camera() : m_camera; }
    /** Linked, of both. */
    void set_camera(Model& model, const Camera& camera);
    void set_size(const std::array<std::uint32_t, 2>& size) { m_size = size; }

    bool shows(std::size_t item) const { return item >= m_is_shown.size() || m_is_shown[item]; }
    /** Items count as items_of() has them. */
    void set_shown(std::size_t item, bool is_shown);

    /** Takes what has changed in the model, or here. To be called before the following. */
    void follow(const Model& model);
    const Scene& scene() const { return m_scene; }
    /** Grows with everything that changes its picture. */
    std::uint64_t revision() const { return m_revision; }

private:
    void follow_items(const Scene& first);

    bool m_is_on = false, m_is_linked = true;
    Camera m_camera{};
    std::array<std::uint32_t, 2> m_size{1, 1};
    /** Of each item, what the scene said of it when it was last looked at, and whether it is shown here. */
    std::vector<std::string> m_items;
    std::vector<bool> m_is_shown;
    Scene m_scene;
    std::uint64_t m_revision = 0;
};

} // namespace elvis::view
