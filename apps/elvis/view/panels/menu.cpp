#include "panels.hpp"

#include <filesystem>

namespace elvis::view {

namespace {

bool item(Ui& ui, const std::string& name, const char* label, const char* keys, const char* help, bool is_enabled = true) {
    const bool is_chosen = ImGui::MenuItem(label, keys, false, is_enabled);
    explain(ui, name, help);
    return is_chosen;
}

bool menu(Ui& ui, const char* label) {
    const bool is_open = ImGui::BeginMenu(label);
    ui.places[std::string("menu/") + label] = {ImGui::GetItemRectMin().x, ImGui::GetItemRectMin().y, ImGui::GetItemRectMax().x,
                                               ImGui::GetItemRectMax().y};
    return is_open;
}

void file_menu(Ui& ui) {
    const bool has_volume = ui.model().volume().has_value();
    if (item(ui, "menu/open", "Open...", "Ctrl+O", "A volume, a scene, or a foreign file that is then converted")) {
        ui.next_dialog = Dialog::open;
    }
    if (ImGui::BeginMenu("Recent files", !ui.settings.recent_files.empty())) {
        const std::vector<std::string> files = ui.settings.recent_files; // Opening changes the list.
        for (const std::string& path : files) {
            if (item(ui, "recent/" + path, path.c_str(), nullptr, "")) {
                ui.bench.open(path);
            }
        }
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (item(ui, "menu/save", "Save scene", "Ctrl+S", "What is seen, as a file that elvis render draws to the same picture",
             has_volume)) {
        if (ui.model().file().empty()) {
            ui.next_dialog = Dialog::save_scene;
        } else {
            ui.bench.save_scene(ui.model().file());
        }
    }
    if (item(ui, "menu/save as", "Save scene as...", "Ctrl+Shift+S", "The same under another name", has_volume)) {
        ui.next_dialog = Dialog::save_scene;
    }
    if (item(ui, "menu/save picture", "Save picture...", "Ctrl+P", "The picture as PNG, SVG or PDF, in any size", has_volume)) {
        ui.next_dialog = Dialog::save_picture;
    }
    if (item(ui, "menu/write", "Write as numbers...", "Ctrl+E",
             "Surfaces and streamlines that are shown, the line, or a grid of points, as files for other programs",
             has_volume)) {
        ui.next_dialog = Dialog::write_data;
    }
    ImGui::Separator();
    if (item(ui, "menu/quit", "Quit", "Ctrl+Q", "")) {
        ui.wants_to_quit = true;
    }
}

void edit_menu(Ui& ui) {
    const auto undo = ui.model().undo_name();
    const auto redo = ui.model().redo_name();
    if (item(ui, "menu/undo", undo ? ("Undo: " + *undo).c_str() : "Undo", "Ctrl+Z", "Takes the last change back",
             undo.has_value())) {
        ui.model().undo();
    }
    if (item(ui, "menu/redo", redo ? ("Redo: " + *redo).c_str() : "Redo", "Ctrl+Y", "Makes it again", redo.has_value())) {
        ui.model().redo();
    }
}

void view_menu(Ui& ui) {
    Model& model = ui.model();
    const bool has_volume = model.volume().has_value();
    if (item(ui, "menu/fit", "Fit", "F", "Moves the camera until the whole volume is seen", has_volume)) {
        model.set_camera(ui.bench.fitted(model.camera()));
    }
    for (std::size_t i = 0; i < standard_views().size(); ++i) {
        const StandardView& view = standard_views()[i];
        const std::string label = "From " + view.name;
        if (item(ui, "menu/from " + view.name, label.c_str(), std::to_string(i + 1).c_str(), "", has_volume)) {
            model.set_camera(ui.bench.fitted(from_standard_view(model.camera(), view)));
        }
    }
    ImGui::Separator();
    SecondView& second = ui.bench.second();
    if (item(ui, "menu/second view", second.is_on() ? "One view" : "Two views", "Ctrl+2",
             "A second view of the volume beside the first, with its own choice of items", has_volume)) {
        toggle_second_view(ui);
    }
    if (item(ui, "menu/link", second.is_linked() ? "Unlink cameras" : "Link cameras", "Ctrl+L",
             "Linked, both views have one camera; else each its own", second.is_on())) {
        second.set_linked(model, !second.is_linked());
    }
    ImGui::Separator();
    bool is_dark = ui.settings.is_dark;
    if (ImGui::MenuItem("Dark", nullptr, &is_dark)) {
        ui.settings.is_dark = is_dark;
        ui.has_new_look = true;
    }
    explain(ui, "menu/dark", "Dark or light panels");
    float scale = ui.settings.text_scale;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
    if (ImGui::SliderFloat("Text size", &scale, 0.6f, 3.0f, "%.2f")) {
        ui.settings.text_scale = scale;
    }
    explain(ui, "menu/text size", "Size of texts and controls; from the next start on");
}

} // namespace

void draw_menu(Ui& ui) {
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    if (menu(ui, "File")) {
        file_menu(ui);
        ImGui::EndMenu();
    }
    if (menu(ui, "Edit")) {
        edit_menu(ui);
        ImGui::EndMenu();
    }
    if (menu(ui, "View")) {
        view_menu(ui);
        ImGui::EndMenu();
    }
    if (menu(ui, "Help")) {
        if (item(ui, "menu/shortcuts", "Mouse and keys", "F1", "What the mouse and the keys do")) {
            ui.next_dialog = Dialog::shortcuts;
        }
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

} // namespace elvis::view
