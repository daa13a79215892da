#include "application.hpp"

#include "describe.hpp"
#include "view_area.hpp"
#include "window.hpp"
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/view/panels/panels.hpp>

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace elvis::view {

namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;

/** Panels are drawn at most that often, but for new pictures. */
constexpr double frame_seconds = 1.0 / 40;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class Application {
public:
    explicit Application(const Options& options)
        : m_options(options), m_settings(read_settings(settings_file())),
          m_window(with_options(m_settings, options), options.device, options.validation),
          m_bench(std::make_unique<Session>(
              commands::library_context(options.device, options.validation ? ELVIS_CONTEXT_VALIDATION : 0u))),
          m_ui{m_bench, m_settings, m_window.scale()} {
        m_bench.on_file = [this](const std::string& path) {
            m_settings.add_recent(path);
            write_settings(m_settings, settings_file());
        };
        if (!options.files.empty()) {
            m_bench.open_files(options.files);
        }
    }

    void run() {
        while (!m_is_done) {
            const double due = least_seconds() - seconds_since(m_last_frame);
            // The thread that draws is asked, not waited for: GLFW 3.3 may hang where other threads post events.
            const bool has_events = m_window.wait(std::clamp(due, 0.0, m_bench.is_settled() ? 0.5 : 0.005));
            const bool has_news = update();
            if (has_events || has_news || m_bench.activity() != m_shown_activity || m_bench.is_settled() != m_was_settled) {
                // After an event, ImGui takes some frames to settle.
                m_frames_wanted = 3;
            }
            if (has_news || seconds_since(m_last_frame) >= least_seconds()) {
                m_frames_wanted = std::max(0, m_frames_wanted - 1);
                m_shown_activity = m_bench.activity();
                m_was_settled = m_bench.is_settled();
                draw();
            }
        }
        m_settings.window_size = m_window.size();
        write_settings(m_settings, settings_file());
    }

    std::vector<std::string> validation_messages() {
        std::vector<std::string> messages = m_bench.validation_messages();
        const std::vector<std::string> own = m_window.presenter().validation_messages();
        messages.insert(messages.end(), own.begin(), own.end());
        return messages;
    }

private:
    /** From one drawing of the panels to the next, if no picture comes before. */
    double least_seconds() const {
        if (m_frames_wanted == 0 && !is_hand_moving() && !m_ui.is_playing) {
            // Nothing happens, but for what changes by itself.
            return m_bench.is_settled() ? 0.5 : 0.2;
        }
        // Where the device is the CPU, panels that are drawn too often are in the way of the picture that is being drawn.
        constexpr double share = 0.25;
        constexpr double longest = 0.1;
        return m_bench.is_drawing() ? std::clamp(m_panel_seconds / share, frame_seconds, longest) : frame_seconds;
    }

    bool is_hand_moving() const { return m_view.is_moving() || m_second_view.is_moving(); }
    bool is_moving() { return is_hand_moving() || m_ui.is_playing || m_ui.is_dragging || m_bench.model().is_in_gesture(); }

    /** For this start only. */
    static Settings with_options(Settings settings, const Options& options) {
        if (options.size) {
            settings.window_size = *options.size;
        }
        if (options.text_scale > 0) {
            settings.text_scale = static_cast<float>(options.text_scale);
        }
        return settings;
    }

    bool update() {
        for (const std::string& path : m_window.dropped()) {
            m_bench.open(path);
        }
        const std::optional<std::size_t> news = m_bench.collect(1000 * m_panel_seconds);
        if (!news) {
            m_bench.go_on(is_moving());
        }
        for (std::size_t view = 0; view < m_has_picture.size(); ++view) {
            const Picture& picture = m_bench.shown(view).picture;
            if (news == view && picture.width > 0) {
                m_window.presenter().set_picture(view, picture.width, picture.height, picture.rgba);
                m_has_picture[view] = true;
            } else if (m_has_picture[view] && picture.width == 0) {
                m_window.presenter().clear_picture(view);
                m_has_picture[view] = false;
            }
        }
        if (m_window.wants_to_close()) {
            m_window.keep_open();
            m_ui.wants_to_quit = true;
        }
        return news.has_value();
    }

    /** A panel at a side whose width the user can change. */
    template <class Content>
    void side_panel(const char* name, float x, float y, float& width, float height, bool is_right, const Content& content) {
        const float scale = m_ui.scale;
        const float shown = width * scale;
        ImGui::SetNextWindowPos(ImVec2(is_right ? x - shown : x, y));
        ImGui::SetNextWindowSize(ImVec2(shown, height));
        if (ImGui::Begin(name, nullptr, fixed_window | ImGuiWindowFlags_NoResize)) {
            ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.5f);
            content();
            ImGui::PopItemWidth();
        }
        ImGui::End();
        // Its inner edge can be dragged.
        const float edge = 5 * scale;
        const float edge_x = is_right ? x - shown - edge : x + shown;
        ImGui::SetNextWindowPos(ImVec2(edge_x, y));
        ImGui::SetNextWindowSize(ImVec2(edge, height));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
        if (ImGui::Begin((std::string(name) + " edge").c_str(), nullptr, fixed_window | ImGuiWindowFlags_NoResize)) {
            ImGui::InvisibleButton("edge", ImVec2(edge, height));
            if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
                ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
            }
            if (ImGui::IsItemActive()) {
                const float by = ImGui::GetIO().MouseDelta.x / scale;
                width = std::clamp(width + (is_right ? -by : by), 180.0f, 0.45f * ImGui::GetIO().DisplaySize.x / scale);
            }
        }
        ImGui::End();
        ImGui::PopStyleVar(3);
    }

    void view_window(const char* name, const ImVec2& corner, const ImVec2& size, ViewArea& view) {
        ImGui::SetNextWindowPos(corner);
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
        if (ImGui::Begin(name, nullptr,
                         fixed_window | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoBackground |
                             ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav)) {
            view.draw(m_ui, m_window.framebuffer_scale());
        }
        ImGui::End();
        ImGui::PopStyleVar(2);
    }

    void draw_layout() {
        const ImVec2 whole = ImGui::GetIO().DisplaySize;
        const float status_height = ImGui::GetFrameHeight() + 4 * m_ui.scale;
        draw_menu(m_ui);
        const float top = ImGui::GetFrameHeight();
        const float height = std::max(1.0f, whole.y - top - status_height);
        const float edge = 5 * m_ui.scale;
        auto& [left, right] = m_settings.panel_widths;
        // Large texts in a small window must leave room for the picture.
        const float most = 0.6f * whole.x / m_ui.scale;
        if (left + right > most) {
            const float share = most / (left + right);
            left *= share;
            right *= share;
        }

        side_panel("left", 0, top, left, height, false, [this] {
            draw_items(m_ui);
            draw_item_editor(m_ui);
        });
        side_panel("right", whole.x, top, right, height, true, [this] { draw_tabs(); });

        const float x = left * m_ui.scale + edge;
        const float width = std::max(1.0f, whole.x - (left + right) * m_ui.scale - 2 * edge);
        const bool has_time = m_ui.model().volume() && m_ui.model().volume()->times.size() > 1;
        const float time_height = has_time ? 1.8f * ImGui::GetFrameHeight() : 0;
        const float view_height = std::max(1.0f, height - time_height);
        const bool has_second = m_bench.second().is_on();
        const float view_width = has_second ? std::max(1.0f, 0.5f * (width - edge)) : width;
        view_window("view window", ImVec2(x, top), ImVec2(view_width, view_height), m_view);
        if (has_second) {
            view_window("second view window", ImVec2(x + view_width + edge, top), ImVec2(view_width, view_height),
                        m_second_view);
        }
        if (has_time) {
            ImGui::SetNextWindowPos(ImVec2(x, top + height - time_height));
            ImGui::SetNextWindowSize(ImVec2(width, time_height));
            if (ImGui::Begin("time", nullptr, fixed_window | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoScrollbar)) {
                draw_time(m_ui);
            }
            ImGui::End();
        }
        ImGui::SetNextWindowPos(ImVec2(0, whole.y - status_height));
        ImGui::SetNextWindowSize(ImVec2(whole.x, status_height));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(8 * m_ui.scale, 3 * m_ui.scale));
        if (ImGui::Begin("status", nullptr, fixed_window | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoScrollbar)) {
            draw_status(m_ui);
        }
        ImGui::End();
        ImGui::PopStyleVar();
    }

    void draw_tabs() {
        if (!ImGui::BeginTabBar("tabs")) {
            return;
        }
        const auto tab = [this](const char* name, const char* help, void (*content)(Ui&), bool is_wanted) {
            const bool is_open = ImGui::BeginTabItem(name, nullptr, is_wanted ? ImGuiTabItemFlags_SetSelected : 0);
            explain(m_ui, std::string("tab/") + name, help);
            if (is_open) {
                content(m_ui);
                ImGui::EndTabItem();
            }
        };
        // A new point comes to the front.
        const bool is_new = m_bench.picked() && !m_had_picked;
        m_had_picked = m_bench.picked().has_value();
        tab("Scene", "Field, colours, lines and light of everything that has none of its own", draw_scene_editor, false);
        tab("Camera", "Where the picture is seen from", draw_camera, false);
        tab("Point", "What is known of the point that was clicked on", draw_picked, is_new);
        tab("Line", "A field along a straight line through the volume, as a plot", draw_line_probe, false);
        tab("Numbers", "Integrals and extrema of what is shown", draw_numbers, false);
        tab("Picture", "What drawing the picture took, and what is not certain in it", draw_statistics, false);
        ImGui::EndTabBar();
    }

    void draw() {
        m_last_frame = Clock::now();
        m_window.begin_frame();
        m_ui.scale = m_window.scale();
        m_ui.places.clear();
        m_ui.is_dragging = false;
        m_ui.keys = m_window.pressed_keys();
        if (m_ui.has_new_look) {
            m_ui.has_new_look = false;
            m_window.set_look(m_settings.is_dark);
        }
        Model& model = m_bench.model();
        handle_shortcuts(m_ui);
        draw_layout();
        draw_dialogs(m_ui);
        if (!ImGui::IsAnyItemHovered()) {
            m_ui.hovered.clear();
        }
        if (!ImGui::IsAnyItemActive()) {
            model.end_gesture();
        }
        const auto size_of = [](const ViewArea& view) {
            return std::array{static_cast<std::uint32_t>(view.box().width), static_cast<std::uint32_t>(view.box().height)};
        };
        model.set_size(size_of(m_view));
        std::vector<PixelBox> boxes{m_view.box()};
        if (m_bench.second().is_on() && m_second_view.box().width > 0) {
            m_bench.second().set_size(size_of(m_second_view));
            boxes.push_back(m_second_view.box());
        }
        set_title();
        // The next picture is begun before this one is shown.
        m_bench.go_on(is_moving());
        m_window.end_frame(boxes);
        m_panel_seconds = seconds_since(m_last_frame);
        if (m_ui.has_leave_to_quit) {
            m_is_done = true;
        }
        if (!m_options.description.empty()) {
            describe();
        }
    }

    void set_title() {
        const Model& model = m_bench.model();
        const std::string path = !model.file().empty() ? model.file() : part_of(model.scene(), "volume").value("path", "");
        const std::string name = std::filesystem::path(path).filename().string();
        const std::string title = name.empty() ? "ElVis" : name + " - ElVis";
        if (title != m_title) {
            m_window.set_title(title);
            m_title = title;
        }
    }

    void describe() {
        const std::string text = description(m_ui);
        if (text != m_description) {
            write_text_file(m_options.description, text);
            m_description = text;
        }
    }

    Options m_options;
    Settings m_settings;
    Window m_window;
    Workbench m_bench;
    Ui m_ui;
    ViewArea m_view{0}, m_second_view{1};
    bool m_is_done = false;
    bool m_was_settled = false;
    std::array<bool, 2> m_has_picture{};
    bool m_had_picked = false;
    int m_frames_wanted = 3;
    Clock::time_point m_last_frame{};
    /** What drawing the panels took the last time. */
    double m_panel_seconds = 0;
    std::string m_shown_activity;
    std::string m_title;
    std::string m_description;
};

} // namespace

void run(const Options& options) {
    Application application(options);
    application.run();
    const std::vector<std::string> messages = application.validation_messages();
    if (options.validation && !messages.empty()) {
        throw Error("validation layer", messages.front());
    }
}

} // namespace elvis::view
