#include "panels.hpp"

#include <core/scene/color/color_map.hpp>

namespace elvis::view {

namespace {

/** Which field and colours, if not the scene's. */
bool edit_looks(Ui& ui, SceneSurface& surface) {
    const SurfaceTraits traits = traits_of(surface.geometry);
    const bool is_isosurface = traits.isosurfaces != nullptr;
    bool is_changed = false;
    if (traits.wires != nullptr) {
        Rgb rgb = surface.color_map && !surface.color_map->points.empty() ? surface.color_map->points[0].rgb : Rgb{0, 0, 0};
        if (color(ui, "surface/color", "Colour", rgb, "Of the lines")) {
            surface.color_map = uniform_color_map(rgb);
            is_changed = true;
        }
        return is_changed;
    }
    is_changed = field_choice(ui, "surface/field", "Field", surface.field, true,
                              is_isosurface ? "Field or expression that has the values" : "Field or expression that is shown");
    if (is_isosurface) {
        is_changed = field_choice(ui, "surface/color field", "Coloured by", surface.color_field, true,
                                  "Field or expression that colours it; by default the one that has the values") ||
                     is_changed;
    }
    const bool may_be_plain = is_isosurface || surface.streamlines;
    const bool is_plain = may_be_plain && surface.color_map && surface.color_map->points.size() == 1;
    if (may_be_plain) {
        bool has_color = is_plain;
        if (check(ui, "surface/plain", "One colour", has_color, "In place of a colour map")) {
            surface.color_map = has_color ? std::optional(uniform_color_map({0.9, 0.6, 0.2})) : std::nullopt;
            if (has_color) {
                surface.color_field.reset();
            }
            return true;
        }
        if (is_plain) {
            Rgb rgb = surface.color_map->points[0].rgb;
            if (color(ui, "surface/color", "Colour", rgb, "Of the surface")) {
                surface.color_map = uniform_color_map(rgb);
                is_changed = true;
            }
        }
    }
    if (!is_plain) {
        bool has_map = surface.color_map.has_value();
        if (check(ui, "surface/own map", "Own colours", has_map, "Else they are those of the scene")) {
            surface.color_map = has_map ? std::optional(ui.scene().color_map) : std::nullopt;
            is_changed = true;
        }
        if (surface.color_map) {
            const std::optional<std::string>& own = surface.color_field ? surface.color_field : surface.field;
            is_changed = edit_color_map(ui, "surface/colors", *surface.color_map, own ? own : ui.scene().field) || is_changed;
        }
    }
    return is_changed;
}

bool edit_clip(Ui& ui, SceneSurface& surface) {
    bool is_changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < surface.clip.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        std::array<double, 4> plane = surface.clip[i];
        ImGui::DragScalarN("##clip", ImGuiDataType_Double, plane.data(), 4, 0.01f, nullptr, nullptr, "%.4g");
        explain(ui, "surface/clip" + std::to_string(i), "a, b, c, d: where a x + b y + c z + d < 0 the surface is cut away");
        if (plane != surface.clip[i]) {
            surface.clip[i] = plane;
            is_changed = true;
        }
        ImGui::SameLine();
        if (small_button(ui, "surface/clip" + std::to_string(i) + "/remove", "-", "Cuts no longer")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        surface.clip.erase(surface.clip.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    if (small_button(ui, "surface/clip/add", "Cut away ...", "Leaves out what is behind a plane")) {
        const auto& b = ui.model().volume()->bounds;
        surface.clip.push_back({1, 0, 0, -0.5 * (b[0] + b[3])});
        is_changed = true;
    }
    return is_changed;
}

bool edit_surface(Ui& ui, SceneSurface& surface) {
    bool is_changed =
        text(ui, "surface/name", "Name", surface.name, "By which expressions speak of it: distance(NAME)", "none");
    is_changed = (surface.streamlines ? edit_streamlines(ui, *surface.streamlines) : edit_geometry(ui, surface)) || is_changed;
    ImGui::Separator();
    is_changed = edit_looks(ui, surface) || is_changed;
    is_changed =
        slider(ui, "surface/opacity", "Opacity", surface.opacity, 0, 1, "Below 1, what is behind can be seen") || is_changed;
    const SurfaceTraits traits = traits_of(surface.geometry);
    if (traits.wires == nullptr) {
        is_changed = check(ui, "surface/lit", "Lit", surface.is_lit, "Whether the scene's light falls on it") || is_changed;
        is_changed = edit_contours(ui, "surface/contours", surface.contours) || is_changed;
        is_changed = edit_mesh_lines(ui, "surface/mesh lines", surface.mesh_lines) || is_changed;
    }
    if (traits.may_lie_outside) {
        is_changed = optional_color(ui, "surface/outside", "Outside", surface.outside, {0.8, 0.8, 0.8},
                                    "Colour where it lies in no element; else one sees through it there") ||
                     is_changed;
    }
    is_changed = edit_clip(ui, surface) || is_changed;
    return is_changed;
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
        bool is_changed = false;
        switch (item->kind) {
        case ItemKind::surface:
            is_changed = edit_surface(ui, scene.surfaces[item->index]);
            break;
        case ItemKind::volume:
            is_changed = edit_volume_rendering(ui, *scene.volume_rendering);
            break;
        case ItemKind::light:
            is_changed = edit_light(ui, scene.lighting->lights[item->index]);
            break;
        case ItemKind::hidden_light:
            is_changed = edit_light(ui, scene.hidden_lights[item->index]);
            break;
        }
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
