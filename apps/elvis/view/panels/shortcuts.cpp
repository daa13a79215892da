#include "panels.hpp"

namespace elvis::view {

namespace {

/** Letters and digits as GLFW numbers them, which is by their capital ASCII. */
bool pressed(char key) { return ImGui::IsKeyPressed(key, false); }

void handle_control_keys(Ui& ui, bool has_shift) {
    Model& model = ui.model();
    const bool has_volume = model.volume().has_value();
    if (pressed('O')) {
        ui.next_dialog = Dialog::open;
    } else if (pressed('Q')) {
        ui.wants_to_quit = true;
    } else if (pressed('S') && has_volume) {
        if (has_shift || model.file().empty()) {
            ui.next_dialog = Dialog::save_scene;
        } else {
            ui.bench.save_scene(model.file());
        }
    } else if (pressed('P') && has_volume) {
        ui.next_dialog = Dialog::save_picture;
    } else if (pressed('Z')) {
        if (has_shift) {
            model.redo();
        } else {
            model.undo();
        }
    } else if (pressed('Y')) {
        model.redo();
    }
}

void handle_plain_keys(Ui& ui) {
    Model& model = ui.model();
    const double aspect = static_cast<double>(ui.scene().size[0]) / ui.scene().size[1];
    const auto& bounds = model.volume()->bounds;
    for (std::size_t i = 0; i < standard_views().size(); ++i) {
        if (pressed(static_cast<char>('1' + i))) {
            model.set_camera(from_standard_view(model.camera(), standard_views()[i], bounds, aspect));
        }
    }
    if (pressed('F')) {
        model.set_camera(fitted(model.camera(), bounds, aspect));
    } else if (pressed('O')) {
        model.set_camera(with_projection(model.camera(), !model.camera().orthographic));
    } else if (pressed('H')) {
        if (const std::optional<ItemId> item = model.selection()) {
            Scene scene = ui.scene();
            const bool shown = !is_shown(scene, *item);
            const ItemId now = set_shown(scene, *item, shown);
            model.edit((shown ? "show " : "hide ") + item_kind_name(scene, now), std::move(scene));
            model.end_gesture();
            model.select(now);
        }
    } else if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete), false)) {
        if (const std::optional<ItemId> item = model.selection()) {
            Scene scene = ui.scene();
            const std::string what = "remove " + item_kind_name(scene, *item);
            remove(scene, *item);
            model.edit(what, std::move(scene));
            model.end_gesture();
        }
    } else if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Space), false) && model.volume()->times.size() > 1) {
        ui.is_playing = !ui.is_playing;
    }
}

} // namespace

const std::vector<std::pair<const char*, const char*>>& shortcut_texts() {
    static const std::vector<std::pair<const char*, const char*>> texts = {
        {"drag", "turn the volume"},
        {"Shift + drag, middle button", "move it"},
        {"Ctrl + drag", "turn the picture"},
        {"wheel", "zoom to the cursor"},
        {"right button", "zoom"},
        {"click", "what is known of this point"},
        {"drag a yellow handle", "move or turn the selected item"},
        {"double click on a number", "type it"},
        {"1 to 6, 7", "look from +x, -x, +y, -y, +z, -z, a corner"},
        {"F", "see the whole volume"},
        {"O", "perspective or orthographic"},
        {"H", "hide or show the selected item"},
        {"Delete", "remove the selected item"},
        {"Space", "play time steps"},
        {"Ctrl + Z, Ctrl + Y", "undo, redo"},
        {"Ctrl + O", "open"},
        {"Ctrl + S, Ctrl + Shift + S", "save the scene"},
        {"Ctrl + P", "save the picture"},
        {"Ctrl + Q", "quit"},
        {"F1", "this list"}};
    return texts;
}

void handle_shortcuts(Ui& ui) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ui.dialog != Dialog::none || io.WantTextInput) {
        return;
    }
    constexpr int f1 = 290; // GLFW_KEY_F1; ImGui 1.86 has no name for it.
    if (ImGui::IsKeyPressed(f1, false)) {
        ui.next_dialog = Dialog::shortcuts;
    }
    if (io.KeyCtrl) {
        handle_control_keys(ui, io.KeyShift);
    } else if (ui.model().volume()) {
        handle_plain_keys(ui);
    }
}

} // namespace elvis::view
