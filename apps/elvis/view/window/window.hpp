/**
 * @file window.hpp
 * A window of the desktop, by GLFW, with ImGui in it.
 */
#pragma once

#include "presenter.hpp"
#include "ui.hpp"
#include <apps/elvis/view/model/settings.hpp>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct GLFWwindow;

namespace elvis::view {

class Window {
public:
    /** An Error if there is no display. `text_scale` times what the screen asks for. */
    Window(const Settings& settings, const std::string& device, bool validation);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /** Units of ImGui for a length of one: grows with the density of the screen and the wish of the user. */
    float scale() const { return m_scale; }
    /** Pixels of the framebuffer a unit of ImGui. */
    float framebuffer_scale() const;
    Presenter& presenter() { return *m_presenter; }

    void set_look(bool is_dark);
    void set_title(const std::string& title);
    std::array<int, 2> size() const;
    /** The user wants to close it. Asked for again by calling keep_open(). */
    bool wants_to_close() const;
    void keep_open();
    /** Waits for events, at most that long, and handles them. Returns whether there may have been some. */
    bool wait(double seconds);
    /** Files that were dropped onto it since the last call. */
    std::vector<std::string> dropped();

    /** Keys that went down since the last call. */
    std::vector<KeyPress> pressed_keys();

    void begin_frame();
    /** `views`: where their pictures go. */
    void end_frame(std::span<const PixelBox> views);

private:
    static void on_event(GLFWwindow* window);
    void set_callbacks();
    /**
     * ImGui 1.86 takes a press for what was below the cursor in the frame before. A press that comes with a movement waits for
     * the next frame, which knows what the cursor has come to.
     */
    void hold_presses();
    /** It misses keys that go up again before the next frame: in that one they are down. */
    void replay_keys();

    GLFWwindow* m_window = nullptr;
    float m_scale = 1;
    bool m_has_events = true;
    std::vector<std::string> m_dropped;
    std::vector<KeyPress> m_keys;
    struct Press {
        int key, modifiers;
    };
    std::vector<Press> m_presses;
    std::vector<int> m_replayed;
    std::vector<ImWchar> m_late_characters;
    std::array<float, 2> m_cursor{};
    std::array<bool, 5> m_is_down{}, m_is_held{};
    std::unique_ptr<Presenter> m_presenter;
};

} // namespace elvis::view
