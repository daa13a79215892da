#include "panels.hpp"

namespace elvis::view {

namespace {

bool edit_lighting(Ui& ui, Scene& scene) {
    bool is_lit = scene.lighting.has_value();
    bool is_changed = check(ui, "scene/light", "Light", is_lit, "Else colours are exactly those of the colour map");
    if (is_changed) {
        scene.lighting = is_lit ? std::optional(Lighting{}) : std::nullopt;
        scene.hidden_lights.clear();
    }
    if (!scene.lighting) {
        return is_changed;
    }
    ImGui::Indent();
    Lighting& lighting = *scene.lighting;
    is_changed = color(ui, "scene/ambient", "Ambient", lighting.ambient, "Light from everywhere") || is_changed;
    ImGui::SameLine();
    is_changed = color(ui, "scene/headlight", "Headlight", lighting.headlight, "Light from the eye") || is_changed;
    is_changed = slider(ui, "scene/specular", "Highlights", lighting.specular, 0, 1, "Strength of highlights") || is_changed;
    if (lighting.specular > 0) {
        is_changed =
            slider(ui, "scene/exponent", "Sharpness", lighting.exponent, 1, 200, "The larger, the smaller are highlights") ||
            is_changed;
    }
    ImGui::Unindent();
    return is_changed;
}

bool edit_annotation(Ui& ui, Scene& scene) {
    bool has = scene.annotation.has_value();
    bool is_changed = check(ui, "scene/annotation", "Annotation", has, "Colour bars, axes and a title on the picture");
    if (is_changed) {
        scene.annotation = has ? std::optional(SceneAnnotation{}) : std::nullopt;
    }
    if (!scene.annotation) {
        return is_changed;
    }
    ImGui::Indent();
    SceneAnnotation& annotation = *scene.annotation;
    bool has_own_title = annotation.title.has_value();
    if (check(ui, "scene/own title", "Own title", has_own_title, "Else the name of the volume; an empty one for none")) {
        annotation.title = has_own_title ? std::optional(std::string()) : std::nullopt;
        is_changed = true;
    }
    if (annotation.title) {
        is_changed =
            text(ui, "scene/title", "Title", *annotation.title, "Written at the top; nothing if empty", "none") || is_changed;
    }
    is_changed = check(ui, "scene/bars", "Colour bars", annotation.has_color_bars, "What the colours mean") || is_changed;
    ImGui::SameLine();
    is_changed = check(ui, "scene/left", "at the left", annotation.style.bars_at_left, "Else at the right") || is_changed;
    is_changed = check(ui, "scene/axes", "Axes", annotation.has_axes, "Directions of x, y and z") || is_changed;
    is_changed = slider(ui, "scene/text size", "Text size", annotation.style.text_size, 0.01, 0.1,
                        "As part of the picture's shorter side") ||
                 is_changed;
    ImGui::Unindent();
    return is_changed;
}

bool edit_image(Ui& ui, Scene& scene) {
    Rgb background = {scene.background[0], scene.background[1], scene.background[2]};
    bool is_changed = color(ui, "scene/background", "Background", background, "Colour where nothing is");
    if (is_changed) {
        std::copy(background.begin(), background.end(), scene.background.begin());
    }
    static const std::vector<std::string> words = {name_of(Precision::float32), name_of(Precision::float64)};
    auto precision = static_cast<std::size_t>(scene.precision.value_or(Precision::float32));
    if (choice(ui, "scene/precision", "Precision", precision, words,
               "float64 is slower, and within 1e-9 of exact arithmetic instead of 0.001")) {
        scene.precision = static_cast<Precision>(precision);
        is_changed = true;
    }
    int subdivisions = static_cast<int>(scene.subdivisions);
    if (ImGui::SliderInt("Line refinement", &subdivisions, 0, 12, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        scene.subdivisions = static_cast<std::uint32_t>(subdivisions);
        is_changed = true;
    }
    explain(ui, "scene/subdivisions",
            "Contours and mesh lines: how often a pixel is halved at most to decide whether it meets one; more leave fewer "
            "undecided");
    return is_changed;
}

} // namespace

void draw_scene_editor(Ui& ui) {
    if (!ui.model().volume()) {
        return;
    }
    if (ImGui::BeginChild("scene editor")) {
        ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.5f);
        Scene scene = ui.scene();
        std::string what;
        const auto did = [&what](const char* name, bool is_changed) {
            if (is_changed) {
                what = name;
            }
        };
        did("field",
            field_choice(ui, "scene/field", "Field", scene.field, false,
                         "What is shown: a field, or any expression over fields such as norm(grad(p)) / (1 + u[0]^2)"));
        did("colours", edit_color_map(ui, "scene/colors", scene.color_map, scene.field));
        ImGui::Separator();
        did("contours", edit_contours(ui, "scene/contours", scene.contours));
        did("mesh lines", edit_mesh_lines(ui, "scene/mesh lines", scene.mesh_lines));
        ImGui::Separator();
        did("light", edit_lighting(ui, scene));
        ImGui::Separator();
        did("displacement", edit_warp(ui, scene.warp));
        ImGui::Separator();
        did("annotation", edit_annotation(ui, scene));
        ImGui::Separator();
        did("picture", edit_image(ui, scene));
        ImGui::PopItemWidth();
        if (!what.empty()) {
            ui.model().edit("change " + what, std::move(scene));
        }
    }
    ImGui::EndChild();
}

} // namespace elvis::view
