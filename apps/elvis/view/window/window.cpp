#include "window.hpp"
#include "glfw_library.hpp"

#include <core/base/error.hpp>
#include <core/base/font_paths.hpp>
#include <core/vulkan/vulkan_library.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <utility>

namespace elvis::view {

namespace {

std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown";
}

/** The first of the fonts for annotation that is there; else ImGui's own, which has no Greek letters. */
void load_font(float scale) {
    const float size = std::round(14 * scale);
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    static const ImWchar ranges[] = {0x20, 0xff, 0x370, 0x3ff, 0x2010, 0x2027, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};
    for (const std::string& path : default_font_paths()) {
        if (std::filesystem::exists(path) && atlas->AddFontFromFileTTF(path.c_str(), size, nullptr, ranges) != nullptr) {
            return;
        }
    }
    ImFontConfig config;
    config.SizePixels = size;
    atlas->AddFontDefault(&config);
}

/** By what is written on the key: its number in GLFW is that of the same place on an American keyboard. */
KeyPress key_press(int key, int scancode, int modifiers) {
    KeyPress press;
    const char* name = glfwGetKeyName(key, scancode);
    if (name != nullptr && name[0] != '\0' && name[1] == '\0' && std::isalnum(static_cast<unsigned char>(name[0])) != 0) {
        press.letter = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    } else if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
        press.letter = static_cast<char>(key); // Where digits take Shift.
    }
    press.is_delete = key == GLFW_KEY_DELETE;
    press.is_space = key == GLFW_KEY_SPACE;
    press.is_f1 = key == GLFW_KEY_F1;
    press.with_control = (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0;
    press.with_shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    return press;
}

void set_style(float scale, bool is_dark) {
    ImGuiStyle style;
    if (is_dark) {
        ImGui::StyleColorsDark(&style);
    } else {
        ImGui::StyleColorsLight(&style);
    }
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.WindowBorderSize = 1;
    // What is below would make texts hard to read.
    style.Colors[ImGuiCol_WindowBg].w = style.Colors[ImGuiCol_PopupBg].w = 1;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

} // namespace

Window::Window(const Settings& settings, const std::string& device, bool validation) {
    if (!glfw_library().is_there()) {
        throw Error("window", "GLFW cannot be loaded, nor what it needs of X11: " + glfw_library().missing_because() +
                                  ". Install them, or draw with elvis render");
    }
    if (glfwInit() != GLFW_TRUE) {
        const char* display = std::getenv("DISPLAY");
        const bool has_display = display != nullptr && *display != '\0';
        throw Error("window", (has_display ? "the display '" + std::string(display) + "' cannot be opened"
                                           : std::string("there is no display ($DISPLAY is not set)")) +
                                  ": " + glfw_reason() + ". Without one, draw with elvis render, or use xvfb-run");
    }
    try {
        if (glfwVulkanSupported() != GLFW_TRUE) {
            throw Error("window", why_no_devices());
        }
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        m_window = glfwCreateWindow(settings.window_size[0], settings.window_size[1], "ElVis", nullptr, nullptr);
        if (m_window == nullptr) {
            throw Error("window", "it cannot be opened: " + glfw_reason());
        }
        float content_x = 1, content_y = 1;
        glfwGetWindowContentScale(m_window, &content_x, &content_y);
        // Where the framebuffer is finer than the window's units, ImGui scales by itself.
        m_scale = std::max(0.5f, content_x / framebuffer_scale()) * settings.text_scale;

        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        set_style(m_scale, settings.is_dark);
        load_font(m_scale * framebuffer_scale());
        ImGui::GetIO().FontGlobalScale = 1 / framebuffer_scale();

        set_callbacks();
        ImGui_ImplGlfw_InitForVulkan(m_window, true);
        m_presenter = std::make_unique<Presenter>(m_window, device, validation);
    } catch (...) {
        if (ImGui::GetCurrentContext() != nullptr) {
            if (ImGui::GetIO().BackendPlatformUserData != nullptr) {
                ImGui_ImplGlfw_Shutdown();
            }
            ImGui::DestroyContext();
        }
        glfwTerminate();
        throw;
    }
}

Window::~Window() {
    m_presenter.reset();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(m_window);
    glfwTerminate();
}

void Window::set_callbacks() {
    // ImGui's own callbacks call these after themselves.
    glfwSetWindowUserPointer(m_window, this);
    glfwSetCursorPosCallback(m_window, [](GLFWwindow* window, double, double) { on_event(window); });
    glfwSetMouseButtonCallback(m_window, [](GLFWwindow* window, int, int, int) { on_event(window); });
    glfwSetScrollCallback(m_window, [](GLFWwindow* window, double, double) { on_event(window); });
    glfwSetKeyCallback(m_window, [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
        if (action == GLFW_PRESS) {
            auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
            self->m_keys.push_back(key_press(key, scancode, modifiers));
            self->m_presses.push_back({key, modifiers});
        }
        on_event(window);
    });
    glfwSetCharCallback(m_window, [](GLFWwindow* window, unsigned) { on_event(window); });
    glfwSetWindowFocusCallback(m_window, [](GLFWwindow* window, int) { on_event(window); });
    glfwSetFramebufferSizeCallback(m_window, [](GLFWwindow* window, int, int) { on_event(window); });
    glfwSetWindowRefreshCallback(m_window, [](GLFWwindow* window) { on_event(window); });
    glfwSetWindowCloseCallback(m_window, [](GLFWwindow* window) { on_event(window); });
    glfwSetDropCallback(m_window, [](GLFWwindow* window, int count, const char** paths) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
        self->m_dropped.insert(self->m_dropped.end(), paths, paths + count);
        on_event(window);
    });
}

void Window::on_event(GLFWwindow* window) { static_cast<Window*>(glfwGetWindowUserPointer(window))->m_has_events = true; }

float Window::framebuffer_scale() const {
    int width = 1, height = 1, pixels_across = 1, pixels_down = 1;
    glfwGetWindowSize(m_window, &width, &height);
    glfwGetFramebufferSize(m_window, &pixels_across, &pixels_down);
    return width > 0 && pixels_across > 0 ? static_cast<float>(pixels_across) / static_cast<float>(width) : 1.0f;
}

void Window::set_look(bool is_dark) { set_style(m_scale, is_dark); }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(m_window, title.c_str()); }

std::array<int, 2> Window::size() const {
    std::array<int, 2> size{};
    glfwGetWindowSize(m_window, &size[0], &size[1]);
    return size;
}

bool Window::wants_to_close() const { return glfwWindowShouldClose(m_window) == GLFW_TRUE; }
void Window::keep_open() { glfwSetWindowShouldClose(m_window, GLFW_FALSE); }

bool Window::wait(double seconds) {
    if (seconds > 0 && !m_has_events) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(m_has_events, false);
}

std::vector<std::string> Window::dropped() { return std::exchange(m_dropped, {}); }

std::vector<KeyPress> Window::pressed_keys() { return std::exchange(m_keys, {}); }

void Window::begin_frame() {
    m_presenter->begin_frame();
    ImGui_ImplGlfw_NewFrame();
    hold_presses();
    replay_keys();
    ImGui::NewFrame();
}

void Window::hold_presses() {
    ImGuiIO& io = ImGui::GetIO();
    const bool has_moved = io.MousePos.x != m_cursor[0] || io.MousePos.y != m_cursor[1];
    m_cursor = {io.MousePos.x, io.MousePos.y};
    for (std::size_t button = 0; button < m_is_down.size(); ++button) {
        const bool is_pressed = io.MouseDown[button] && !m_is_down[button] && !m_is_held[button];
        io.MouseDown[button] = io.MouseDown[button] || m_is_held[button];
        m_is_held[button] = is_pressed && has_moved;
        if (m_is_held[button]) {
            io.MouseDown[button] = false;
            m_has_events = true;
        }
        m_is_down[button] = io.MouseDown[button];
    }
}

void Window::replay_keys() {
    ImGuiIO& io = ImGui::GetIO();
    const auto is_down = [this](int key) { return glfwGetKey(m_window, key) == GLFW_PRESS; };
    if (!m_late_characters.empty()) {
        const std::vector<ImWchar> newer(io.InputQueueCharacters.begin(), io.InputQueueCharacters.end());
        io.InputQueueCharacters.resize(0);
        for (const std::vector<ImWchar>& characters : {std::exchange(m_late_characters, {}), newer}) {
            for (const ImWchar character : characters) {
                io.InputQueueCharacters.push_back(character);
            }
        }
    }
    if (!m_replayed.empty()) {
        for (const int key : std::exchange(m_replayed, {})) {
            io.KeysDown[key] = is_down(key);
        }
        io.KeyCtrl = is_down(GLFW_KEY_LEFT_CONTROL) || is_down(GLFW_KEY_RIGHT_CONTROL);
        io.KeyShift = is_down(GLFW_KEY_LEFT_SHIFT) || is_down(GLFW_KEY_RIGHT_SHIFT);
    }
    for (const auto& [key, modifiers] : std::exchange(m_presses, {})) {
        if (key < 0 || key >= static_cast<int>(std::size(io.KeysDown)) || io.KeysDown[key]) {
            continue;
        }
        io.KeysDown[key] = true;
        io.KeyCtrl = io.KeyCtrl || (modifiers & GLFW_MOD_CONTROL) != 0;
        io.KeyShift = io.KeyShift || (modifiers & GLFW_MOD_SHIFT) != 0;
        m_replayed.push_back(key);
        m_has_events = true;
        if (io.KeyCtrl) {
            // Text that was typed after it must not seem to be typed with Ctrl: it comes in the next frame.
            m_late_characters.insert(m_late_characters.end(), io.InputQueueCharacters.begin(), io.InputQueueCharacters.end());
            io.InputQueueCharacters.resize(0);
        }
    }
}

void Window::end_frame(std::span<const PixelBox> views) {
    ImGui::Render();
    m_presenter->present(ImGui::GetDrawData(), views, {0.25f, 0.25f, 0.27f, 1.0f});
}

} // namespace elvis::view
