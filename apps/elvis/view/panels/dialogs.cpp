#include "file_dialog.hpp"
#include "panels.hpp"

#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

namespace elvis::view {

namespace {

namespace fs = std::filesystem;

/** The name, the two buttons, and one line for what else is asked. */
constexpr float usual_lines_below = 3.2f;

/** Goes to a folder that exists. */
void start_in_folder(Ui& ui) {
    DialogState& state = ui.dialog_state;
    std::error_code error;
    if (state.folder.empty() || !fs::is_directory(state.folder, error)) {
        const bool is_known = !ui.settings.folder.empty() && fs::is_directory(ui.settings.folder, error);
        state.folder = is_known ? ui.settings.folder : fs::current_path(error).string();
    }
}

void open_dialog(Ui& ui) {
    bool is_closed = false;
    const bool is_chosen = folder_list(ui, usual_lines_below);
    if (name_and_buttons(ui, "Open", is_closed) || is_chosen) {
        ui.bench.open(chosen_path(ui.dialog_state));
        is_closed = true;
    }
    if (is_closed) {
        ImGui::CloseCurrentPopup();
    }
}

void save_scene_dialog(Ui& ui) {
    bool is_closed = false;
    folder_list(ui, usual_lines_below);
    if (name_and_buttons(ui, "Save", is_closed)) {
        fs::path path = chosen_path(ui.dialog_state);
        if (path.extension().empty()) {
            path += ".json";
        }
        ui.bench.save_scene(path.string());
        is_closed = true;
    }
    if (is_closed) {
        ImGui::CloseCurrentPopup();
    }
}

void save_picture_dialog(Ui& ui) {
    DialogState& state = ui.dialog_state;
    bool is_closed = false;
    folder_list(ui, usual_lines_below);
    int width = static_cast<int>(state.size[0]), height = static_cast<int>(state.size[1]);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
    ImGui::InputInt("x##width", &width);
    explain(ui, "dialog/width", "Width in pixels; may be larger than the window");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
    ImGui::InputInt("pixels##height", &height);
    explain(ui, "dialog/height", "Height in pixels");
    ImGui::SameLine();
    check(ui, "dialog/16", "16 bits", state.has_16_bits, "Bits a channel; else 8");
    state.size = {static_cast<std::uint32_t>(std::clamp(width, 1, 32768)),
                  static_cast<std::uint32_t>(std::clamp(height, 1, 32768))};
    if (name_and_buttons(ui, "Save", is_closed)) {
        fs::path path = chosen_path(state);
        if (path.extension().empty()) {
            path += ".png";
        }
        ui.bench.save_picture(path.string(), state.size, state.has_16_bits ? 16 : 8);
        is_closed = true;
    }
    if (is_closed) {
        ImGui::CloseCurrentPopup();
    }
}

void convert_dialog(Ui& ui) {
    Workbench& bench = ui.bench;
    DialogState& state = ui.dialog_state;
    if (bench.conversion().is_running()) {
        const auto [fraction, activity] = bench.conversion().progress();
        ImGui::TextWrapped("Converting %s", state.input.c_str());
        ImGui::ProgressBar(fraction < 0 ? 0 : static_cast<float>(fraction), ImVec2(-1, 0), fraction < 0 ? "" : nullptr);
        ImGui::TextUnformatted(activity.c_str());
        if (button(ui, "dialog/cancel", "Cancel", "Stops the conversion; nothing is written")) {
            bench.conversion().cancel();
        }
        return;
    }
    if (!bench.foreign_file) {
        ImGui::CloseCurrentPopup(); // It is done.
        return;
    }
    ImGui::TextWrapped(
        "%s is a foreign file. ElVis can convert it to a native volume, which takes a while and is exact where the "
        "spaces allow; the report says where it is not.",
        bench.foreign_file->c_str());
    ImGui::InputText("Volume", &state.name);
    explain(ui, "dialog/name", "Where the native volume is written");
    if (button(ui, "dialog/do", "Convert", "")) {
        state.input = *bench.foreign_file;
        bench.convert(*bench.foreign_file, state.name);
        bench.foreign_file.reset();
    }
    ImGui::SameLine();
    if (button(ui, "dialog/cancel", "Cancel", "")) {
        bench.foreign_file.reset();
        ImGui::CloseCurrentPopup();
    }
}

void shortcuts_dialog(Ui& ui) {
    if (ImGui::BeginTable("shortcuts", 2)) {
        for (const auto& [keys, what] : shortcut_texts()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(what);
        }
        ImGui::EndTable();
    }
    if (button(ui, "dialog/cancel", "Close", "") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        ImGui::CloseCurrentPopup();
    }
}

void quit_dialog(Ui& ui) {
    ImGui::TextUnformatted("The scene has changes that are not saved.");
    if (button(ui, "dialog/do", "Save", "")) {
        ImGui::CloseCurrentPopup();
        if (ui.model().file().empty()) {
            ui.next_dialog = Dialog::save_scene;
        } else {
            ui.bench.save_scene(ui.model().file());
            ui.has_leave_to_quit = !ui.model().is_changed();
        }
    }
    ImGui::SameLine();
    if (button(ui, "dialog/discard", "Leave without saving", "")) {
        ui.has_leave_to_quit = true;
    }
    ImGui::SameLine();
    if (button(ui, "dialog/cancel", "Cancel", "") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        ImGui::CloseCurrentPopup();
    }
}

const char* title_of(Dialog dialog) {
    switch (dialog) {
    case Dialog::open:
        return "Open";
    case Dialog::save_scene:
        return "Save scene";
    case Dialog::save_picture:
        return "Save picture";
    case Dialog::convert:
        return "Convert";
    case Dialog::shortcuts:
        return "Mouse and keys";
    case Dialog::quit:
        return "Leave ElVis";
    case Dialog::write_data:
        return "Write as numbers";
    case Dialog::none:
        break;
    }
    return "";
}

/** What a dialog shows first. */
void prepare(Ui& ui, Dialog dialog) {
    DialogState& state = ui.dialog_state;
    state.is_new = true;
    start_in_folder(ui);
    const std::string& file = ui.model().file();
    const std::string stem = fs::path(file.empty() ? part_of(ui.scene(), "volume").value("path", "") : file).stem().string();
    switch (dialog) {
    case Dialog::open:
        state.name.clear();
        break;
    case Dialog::save_scene:
        state.name = file.empty() ? stem + "-scene.json" : fs::absolute(file).string();
        break;
    case Dialog::save_picture:
        state.name = stem + ".png";
        state.size = size_of(ui.scene());
        break;
    case Dialog::convert:
        state.name = fs::path(ui.bench.foreign_file.value_or("")).replace_extension(".h5").string();
        break;
    case Dialog::write_data:
        begin_data_file(ui, writables_of(ui.scene(), *ui.model().volume(), ui.bench.line).front(), stem);
        break;
    default:
        break;
    }
}

} // namespace

void draw_dialogs(Ui& ui) {
    if (ui.bench.foreign_file && ui.dialog == Dialog::none && !ui.bench.conversion().is_running()) {
        ui.next_dialog = Dialog::convert;
    }
    if (ui.wants_to_quit) {
        ui.wants_to_quit = false;
        if (ui.model().is_changed()) {
            ui.next_dialog = Dialog::quit;
        } else {
            ui.has_leave_to_quit = true;
        }
    }
    if (ui.next_dialog != Dialog::none && ui.dialog == Dialog::none) {
        ui.dialog = std::exchange(ui.next_dialog, Dialog::none);
        prepare(ui, ui.dialog);
        ImGui::OpenPopup(title_of(ui.dialog));
    }
    if (ui.dialog == Dialog::none) {
        return;
    }
    const bool is_small = ui.dialog == Dialog::convert || ui.dialog == Dialog::quit || ui.dialog == Dialog::shortcuts;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    const float width = std::min(0.9f * screen.x, 38 * em);
    ImGui::SetNextWindowSize(ImVec2(width, is_small ? 0 : std::min(0.9f * screen.y, 30 * em)));
    if (!ImGui::BeginPopupModal(title_of(ui.dialog), nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
        ui.dialog = Dialog::none;
        return;
    }
    switch (ui.dialog) {
    case Dialog::open:
        open_dialog(ui);
        break;
    case Dialog::save_scene:
        save_scene_dialog(ui);
        break;
    case Dialog::save_picture:
        save_picture_dialog(ui);
        break;
    case Dialog::convert:
        convert_dialog(ui);
        break;
    case Dialog::shortcuts:
        shortcuts_dialog(ui);
        break;
    case Dialog::quit:
        quit_dialog(ui);
        break;
    case Dialog::write_data:
        write_data_dialog(ui);
        break;
    case Dialog::none:
        break;
    }
    ImGui::EndPopup();
}

} // namespace elvis::view
