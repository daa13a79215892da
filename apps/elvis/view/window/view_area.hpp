/**
 * @file view_area.hpp
 * The part of the window that shows the picture, and the hand in it.
 */
#pragma once

#include "presenter.hpp"
#include "ui.hpp"
#include <apps/elvis/view/scene/handles.hpp>

#include <cstddef>
#include <optional>

namespace elvis::view {

class ViewArea {
public:
    /** Of the first view, 0, or the second one, which has no handles. */
    explicit ViewArea(std::size_t view) : m_view(view) {}

    /** Takes what is left of the present ImGui window. Sizes in pixels of the framebuffer. */
    void draw(Ui& ui, float framebuffer_scale);
    /** Where the picture goes. */
    const PixelBox& box() const { return m_box; }
    /** The hand moves something, or has just done so. */
    bool is_moving() const;

private:
    enum class Drag { none, orbit, pan, zoom, roll, handle };
    Camera camera(Ui& ui) const;
    void set_camera(Ui& ui, const Camera& camera) const;
    void begin_drag(Ui& ui, const PicturePoint& place);
    void go_on(Ui& ui, const PicturePoint& place, const PicturePoint& by);
    /** Of the selected item, and then those of the line. */
    std::vector<Handle> handles(Ui& ui, const Scene& scene) const;
    void drag_handle(Ui& ui, const PicturePoint& place);
    void draw_line(Ui& ui) const;
    void draw_handles(Ui& ui);
    void draw_picked_point(Ui& ui) const;
    /** A place of the picture, for ImGui. */
    ImVec2 on_screen(const PicturePoint& place) const;
    /** Which of the three stages is on the screen. */
    void draw_stage(Ui& ui) const;

    std::size_t m_view;
    PixelBox m_box;
    PictureSize m_size;
    float m_pixels = 1; ///< of the framebuffer, a unit of ImGui
    Drag m_drag = Drag::none;
    double m_dragged = 0; ///< pixels since the button went down
    double m_last_zoom = -1;
    std::optional<std::size_t> m_handle;
    /** When a handle was taken. */
    Scene m_before;
    std::vector<Handle> m_handles_before;
    PicturePoint m_taken{};
};

} // namespace elvis::view
