#include "panels.hpp"

namespace elvis::view {

namespace {

void add_menu(Ui& ui) {
    if (button(ui, "items/add", "Add", "Puts another surface, the volume itself, or a light into the picture")) {
        ImGui::OpenPopup("add");
    }
    if (!ImGui::BeginPopup("add")) {
        return;
    }
    // A value that isosurfaces surely meet, as soon as the range is known.
    const std::optional<FieldRange> range = ui.bench.range(said<std::string>(ui.scene(), "field"));
    const double middle = range ? round_middle({range->lower, range->upper}) : 0;
    for (const NewItemInfo& info : new_items()) {
        const bool is_possible =
            can_add(ui.scene(), *ui.model().volume(), info.item) && (range || info.item != NewItem::isosurface);
        if (ImGui::MenuItem(info.name, nullptr, false, is_possible)) {
            Scene scene = ui.scene();
            const ItemId item = add(scene, *ui.model().volume(), info.item, middle);
            ui.model().edit("add " + item_kind_name(scene, item), std::move(scene));
            ui.model().end_gesture();
            ui.model().select(item);
        }
        explain(ui, std::string("add/") + info.name, info.help);
    }
    ImGui::EndPopup();
}

void row(Ui& ui, const ItemId& item, std::size_t number) {
    Model& model = ui.model();
    ImGui::PushID(static_cast<int>(number));
    const std::string name = "item/" + std::to_string(number);
    bool shown = is_shown(ui.scene(), item);
    if (check(ui, name + "/shown", "##shown", shown, "Whether it is drawn")) {
        Scene scene = ui.scene();
        set_shown(scene, item, shown);
        model.edit((shown ? "show " : "hide ") + item_kind_name(scene, item), std::move(scene));
        model.end_gesture();
    }
    if (ui.bench.second().is_on()) {
        bool shown_there = ui.bench.second().shows(number);
        ImGui::SameLine();
        if (check(ui, name + "/shown in second", "##second", shown_there, "Whether it is drawn in the second view")) {
            ui.bench.second().set_shown(number, shown_there);
        }
    }
    ImGui::SameLine();
    if (ImGui::Selectable(item_label(ui.scene(), item).c_str(), model.selection() == item)) {
        model.select(item);
    }
    explain(ui, name, "Click to change it below");
    ImGui::PopID();
}

} // namespace

void draw_items(Ui& ui) {
    Model& model = ui.model();
    if (!model.volume()) {
        ImGui::TextWrapped("Nothing is open. Drop a file here, or");
        if (button(ui, "items/open", "Open...", "A volume, a scene, or a foreign file that is then converted")) {
            ui.next_dialog = Dialog::open;
        }
        return;
    }
    ImGui::TextUnformatted("In the picture");
    ImGui::SameLine(0, 2 * ImGui::GetFontSize());
    add_menu(ui);
    const std::optional<ItemId> selected = model.selection();
    ImGui::BeginDisabled(!selected);
    ImGui::SameLine();
    if (button(ui, "items/duplicate", "Copy", "Adds another one like the selected item") && selected) {
        Scene scene = ui.scene();
        const ItemId copy = duplicate(scene, *selected);
        model.edit("copy " + item_kind_name(scene, copy), std::move(scene));
        model.end_gesture();
        model.select(copy);
    }
    ImGui::SameLine();
    if (button(ui, "items/remove", "Remove", "Takes the selected item away (Delete)") && selected) {
        Scene scene = ui.scene();
        const std::string what = "remove " + item_kind_name(scene, *selected);
        remove(scene, *selected);
        model.edit(what, std::move(scene));
        model.end_gesture();
    }
    ImGui::EndDisabled();
    const float line = ImGui::GetFrameHeightWithSpacing();
    if (ImGui::BeginChild("list", ImVec2(0, 7.5f * line), true)) {
        const std::vector<ItemId> items = items_of(ui.scene());
        if (items.empty()) {
            ImGui::TextWrapped("Nothing is chosen: the boundary is shown.");
        }
        for (std::size_t i = 0; i < items.size(); ++i) {
            row(ui, items[i], i);
        }
    }
    ImGui::EndChild();
}

} // namespace elvis::view
