#include "file_dialog.hpp"

#include <apps/elvis/view/model/file_list.hpp>

#include <imgui_stdlib.h>

#include <filesystem>

namespace elvis::view {

namespace fs = std::filesystem;

std::string chosen_path(const DialogState& state) {
    const fs::path name(state.name);
    return (name.is_absolute() ? name : fs::path(state.folder) / name).string();
}

bool folder_list(Ui& ui, float n_lines_below) {
    DialogState& state = ui.dialog_state;
    if (button(ui, "dialog/up", "Up", "To the folder that holds this one")) {
        state.folder = fs::path(state.folder).parent_path().string();
    }
    ImGui::SameLine();
    ImGui::TextUnformatted(state.folder.c_str());
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    ImGui::InputTextWithHint("Filter", "part of the name", &state.filter);
    explain(ui, "dialog/filter", "Shows only files with this in their name");
    bool is_done = false;
    if (ImGui::BeginChild("files", ImVec2(0, -n_lines_below * ImGui::GetFrameHeightWithSpacing()), true)) {
        for (const FolderEntry& entry : list_folder(state.folder, state.filter)) {
            const std::string label = entry.is_folder ? entry.name + "/" : entry.name;
            if (ImGui::Selectable(label.c_str(), !entry.is_folder && entry.name == state.name,
                                  ImGuiSelectableFlags_AllowDoubleClick)) {
                if (entry.is_folder) {
                    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
                        state.folder = (fs::path(state.folder) / entry.name).string();
                    }
                } else {
                    state.name = entry.name;
                    is_done = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
                }
            }
            explain(ui, "file/" + entry.name, "");
        }
    }
    ImGui::EndChild();
    return is_done;
}

bool name_and_buttons(Ui& ui, const char* action, bool& is_closed) {
    DialogState& state = ui.dialog_state;
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    if (state.is_new) {
        ImGui::SetKeyboardFocusHere();
        state.is_new = false;
    }
    bool is_done = ImGui::InputText("Name", &state.name, ImGuiInputTextFlags_EnterReturnsTrue);
    explain(ui, "dialog/name", "In the folder above, or with its own path");
    ImGui::BeginDisabled(state.name.empty());
    is_done = button(ui, "dialog/do", action, "") || is_done;
    ImGui::EndDisabled();
    ImGui::SameLine();
    is_closed = button(ui, "dialog/cancel", "Cancel", "Escape") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    return is_done && !state.name.empty();
}

} // namespace elvis::view
