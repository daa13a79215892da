#include "panels.hpp"

namespace elvis::view {

namespace {

constexpr Rgb black{0, 0, 0}, orange{0.9, 0.6, 0.2};

/** One colour in place of a map; for isosurfaces and lines. Returns whether it has one, and whether that changed. */
std::pair<bool, bool> edit_plain(Ui& ui, Json& surface) {
    bool is_changed = optional_part(ui, "surface/plain", "One colour", surface, "color", orange, "In place of a colour map");
    if (!surface.contains("color")) {
        return {false, is_changed};
    }
    if (is_changed) {
        surface.erase("color_map");
        surface.erase("color_field");
    }
    is_changed = color(ui, "surface/color", "Colour", surface, "color", orange, "Of the surface") || is_changed;
    return {true, is_changed};
}

/** Which field and colours, if not the scene's. */
bool edit_looks(Ui& ui, Json& surface, const std::string& type) {
    if (type == "wireframe") {
        return color(ui, "surface/color", "Colour", surface, "color", black, "Of the lines");
    }
    const bool is_isosurface = type == "isosurface";
    bool is_changed =
        field_choice(ui, "surface/field", "Field", surface, "field", true,
                     is_isosurface ? "Field or expression that has the values" : "Field or expression that is shown");
    if (is_isosurface && field_choice(ui, "surface/color field", "Coloured by", surface, "color_field", true,
                                      "Field or expression that colours it; by default the one that has the values")) {
        surface.erase("color");
        is_changed = true;
    }
    if (is_isosurface || type == "streamlines" || type == "pathlines" || type == "arrows") {
        const auto [is_plain, is_other] = edit_plain(ui, surface);
        if (is_plain) {
            return is_changed || is_other;
        }
        is_changed = is_changed || is_other;
    }
    is_changed = optional_part(ui, "surface/own map", "Own colours", surface, "color_map", part_of(ui.scene(), "color_map"),
                               "Else they are those of the scene") ||
                 is_changed;
    if (surface.contains("color_map")) {
        const auto own = said<std::string>(surface, surface.contains("color_field") ? "color_field" : "field");
        is_changed =
            edit_color_map(ui, "surface/colors", surface, own ? own : said<std::string>(ui.scene(), "field")) || is_changed;
    }
    return is_changed;
}

bool edit_clip(Ui& ui, Json& surface) {
    auto clip = surface.value("clip", std::vector<std::array<double, 4>>());
    bool is_changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < clip.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::array<double, 4> before = clip[i];
        ImGui::DragScalarN("##clip", ImGuiDataType_Double, clip[i].data(), 4, 0.01f, nullptr, nullptr, "%.4g");
        explain(ui, "surface/clip" + std::to_string(i), "a, b, c, d: where a x + b y + c z + d < 0 the surface is cut away");
        is_changed = is_changed || clip[i] != before;
        ImGui::SameLine();
        if (small_button(ui, "surface/clip" + std::to_string(i) + "/remove", "-", "Cuts no longer")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        clip.erase(clip.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    if (small_button(ui, "surface/clip/add", "Cut away ...", "Leaves out what is behind a plane")) {
        const auto& b = ui.model().volume()->bounds;
        clip.push_back({1, 0, 0, -0.5 * (b[0] + b[3])});
        is_changed = true;
    }
    if (is_changed) {
        say(surface, "clip", clip.empty() ? std::nullopt : std::optional(clip));
    }
    return is_changed;
}

bool may_lie_outside(const std::string& type) {
    return type != "boundary" && type != "elements" && type != "wireframe" && type != "isosurface" && type != "arrows";
}

bool edit_surface(Ui& ui, Json& surface) {
    const std::string type = surface["type"];
    bool is_changed =
        text(ui, "surface/name", "Name", surface, "name", "By which expressions speak of it: distance(NAME)", "none");
    is_changed = edit_geometry(ui, surface) || is_changed;
    ImGui::Separator();
    is_changed = edit_looks(ui, surface, type) || is_changed;
    is_changed = slider(ui, "surface/opacity", "Opacity", surface, "opacity", 1, 0, 1, "Below 1, what is behind can be seen") ||
                 is_changed;
    if (type != "wireframe") {
        is_changed =
            check(ui, "surface/lit", "Lit", surface, "lighting", true, "Whether the scene's light falls on it") || is_changed;
        is_changed = edit_contours(ui, "surface/contours", surface) || is_changed;
        is_changed = edit_mesh_lines(ui, "surface/mesh lines", surface) || is_changed;
    }
    if (type != "wireframe" && type != "streamlines" && type != "pathlines" && type != "arrows") {
        is_changed = edit_lic(ui, "surface/streaks", surface) || is_changed;
    }
    if (may_lie_outside(type)) {
        is_changed = optional_color(ui, "surface/outside", "Outside", surface, "outside", {0.8, 0.8, 0.8},
                                    "Colour where it lies in no element; else one sees through it there") ||
                     is_changed;
    }
    return edit_clip(ui, surface) || is_changed;
}

} // namespace

void draw_item_editor(Ui& ui) {
    Model& model = ui.model();
    const std::optional<ItemId> item = model.selection();
    if (!model.volume() || !item) {
        return;
    }
    ImGui::Separator();
    ImGui::TextUnformatted(item_label(ui.scene(), *item).c_str());
    if (ImGui::BeginChild("editor")) {
        ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.5f);
        // Controls of different items are different controls.
        ImGui::PushID(static_cast<int>(item->kind));
        ImGui::PushID(static_cast<int>(item->index));
        Scene scene = ui.scene();
        Json& part = part_of(scene, *item);
        const bool is_changed = item->kind == ItemKind::surface  ? edit_surface(ui, part)
                                : item->kind == ItemKind::volume ? edit_volume_rendering(ui, part)
                                                                 : edit_light(ui, part);
        ImGui::PopID();
        ImGui::PopID();
        ImGui::PopItemWidth();
        if (is_changed) {
            model.edit("change " + item_kind_name(scene, *item), std::move(scene));
        }
    }
    ImGui::EndChild();
}

} // namespace elvis::view
