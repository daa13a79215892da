#include "panels.hpp"

namespace elvis::view {

namespace {

void handle_with_control(Ui& ui, const KeyPress& key) {
    Model& model = ui.model();
    const bool has_volume = model.volume().has_value();
    const auto is = [&key](char letter) { return key.letter == letter; };
    if (is('O')) {
        ui.next_dialog = Dialog::open;
    } else if (is('Q')) {
        ui.wants_to_quit = true;
    } else if (is('S') && has_volume) {
        if (key.with_shift || model.file().empty()) {
            ui.next_dialog = Dialog::save_scene;
        } else {
            ui.bench.save_scene(model.file());
        }
    } else if (is('P') && has_volume) {
        ui.next_dialog = Dialog::save_picture;
    } else if (is('E') && has_volume) {
        ui.next_dialog = Dialog::write_data;
    } else if (is('Z')) {
        if (key.with_shift) {
            model.redo();
        } else {
            model.undo();
        }
    } else if (is('Y')) {
        model.redo();
    } else if (is('2') && has_volume) {
        toggle_second_view(ui);
    } else if (is('L') && ui.bench.second().is_on()) {
        ui.bench.second().set_linked(model, !ui.bench.second().is_linked());
    }
}

void handle_alone(Ui& ui, const KeyPress& key) {
    Model& model = ui.model();
    const auto is = [&key](char letter) { return key.letter == letter; };
    for (std::size_t i = 0; i < standard_views().size(); ++i) {
        if (is(static_cast<char>('1' + i))) {
            model.set_camera(ui.bench.fitted(from_standard_view(model.camera(), standard_views()[i])));
        }
    }
    if (is('F')) {
        model.set_camera(ui.bench.fitted(model.camera()));
    } else if (is('O')) {
        model.set_camera(with_projection(model.camera(), !model.camera().orthographic));
    } else if (is('H')) {
        if (const std::optional<ItemId> item = model.selection()) {
            Scene scene = ui.scene();
            const bool shown = !is_shown(scene, *item);
            set_shown(scene, *item, shown);
            model.edit((shown ? "show " : "hide ") + item_kind_name(scene, *item), std::move(scene));
            model.end_gesture();
        }
    } else if (key.is_delete) {
        if (const std::optional<ItemId> item = model.selection()) {
            Scene scene = ui.scene();
            const std::string what = "remove " + item_kind_name(scene, *item);
            remove(scene, *item);
            model.edit(what, std::move(scene));
            model.end_gesture();
        }
    } else if (key.is_space && model.volume()->times.size() > 1) {
        ui.is_playing = !ui.is_playing;
    }
}

} // namespace

void toggle_second_view(Ui& ui) {
    if (ui.bench.second().is_on()) {
        ui.bench.turn_off_second();
    } else {
        ui.bench.turn_on_second();
    }
}

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
        {"Ctrl + 2", "a second view beside the first, or none"},
        {"Ctrl + L", "both views have one camera, or each its own"},
        {"Ctrl + Z, Ctrl + Y", "undo, redo"},
        {"Ctrl + O", "open"},
        {"Ctrl + S, Ctrl + Shift + S", "save the scene"},
        {"Ctrl + P", "save the picture"},
        {"Ctrl + E", "write what is shown as numbers"},
        {"Ctrl + Q", "quit"},
        {"F1", "this list"}};
    return texts;
}

void handle_shortcuts(Ui& ui) {
    for (const KeyPress& key : ui.keys) {
        if (ui.dialog != Dialog::none || ImGui::GetIO().WantTextInput) {
            return;
        }
        if (key.is_f1) {
            ui.next_dialog = Dialog::shortcuts;
        } else if (key.with_control) {
            handle_with_control(ui, key);
        } else if (ui.model().volume()) {
            handle_alone(ui, key);
        }
    }
}

} // namespace elvis::view
