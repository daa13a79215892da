#include "panels.hpp"

namespace elvis::view {

namespace {

constexpr double usual_text_size = 0.026;
constexpr int usual_subdivisions = 5;

bool edit_lighting(Ui& ui, Scene& scene) {
    bool is_changed = optional_part(ui, "scene/light", "Light", scene, "lighting", Json::object(),
                                    "Else colours are exactly those of the colour map");
    if (!scene.contains("lighting")) {
        return is_changed;
    }
    ImGui::Indent();
    Json& lighting = scene["lighting"];
    is_changed =
        color(ui, "scene/ambient", "Ambient", lighting, "ambient", {0.3, 0.3, 0.3}, "Light from everywhere") || is_changed;
    ImGui::SameLine();
    is_changed =
        color(ui, "scene/headlight", "Headlight", lighting, "headlight", {0.7, 0.7, 0.7}, "Light from the eye") || is_changed;
    is_changed =
        slider(ui, "scene/specular", "Highlights", lighting, "specular", 0, 0, 1, "Strength of highlights") || is_changed;
    if (lighting.value("specular", 0.0) > 0) {
        is_changed = slider(ui, "scene/exponent", "Sharpness", lighting, "exponent", 30, 1, 200,
                            "The larger, the smaller are highlights") ||
                     is_changed;
    }
    ImGui::Unindent();
    return is_changed;
}

bool edit_annotation(Ui& ui, Scene& scene) {
    bool is_changed = optional_part(ui, "scene/annotation", "Annotation", scene["image"], "annotation", Json::object(),
                                    "Colour bars, axes and a title on the picture");
    if (!scene["image"].contains("annotation")) {
        return is_changed;
    }
    ImGui::Indent();
    Json& annotation = scene["image"]["annotation"];
    is_changed = optional_part(ui, "scene/own title", "Own title", annotation, "title", "",
                               "Else the name of the volume; an empty one for none") ||
                 is_changed;
    if (auto title = said<std::string>(annotation, "title")) {
        is_changed = text(ui, "scene/title", "Title", *title, "Written at the top; nothing if empty", "none") || is_changed;
        annotation["title"] = *title;
    }
    is_changed = check(ui, "scene/bars", "Colour bars", annotation, "color_bars", true, "What the colours mean") || is_changed;
    ImGui::SameLine();
    bool is_left = annotation.value("bar_side", "right") == "left";
    if (check(ui, "scene/left", "at the left", is_left, "Else at the right")) {
        annotation["bar_side"] = is_left ? "left" : "right";
        is_changed = true;
    }
    is_changed = check(ui, "scene/axes", "Axes", annotation, "axes", true, "Directions of x, y and z") || is_changed;
    is_changed = slider(ui, "scene/text size", "Text size", annotation, "text_size", usual_text_size, 0.01, 0.1,
                        "As part of the picture's shorter side") ||
                 is_changed;
    ImGui::Unindent();
    return is_changed;
}

bool edit_image(Ui& ui, Scene& scene) {
    auto background = scene["image"].value("background", std::array<double, 4>{1, 1, 1, 1});
    Rgb rgb = {background[0], background[1], background[2]};
    bool is_changed = color(ui, "scene/background", "Background", rgb, "Colour where nothing is");
    if (is_changed) {
        std::copy(rgb.begin(), rgb.end(), background.begin());
        scene["image"]["background"] = background;
    }
    is_changed = choice(ui, "scene/precision", "Precision", scene, "precision", {"float32", "float64"},
                        "float64 is slower, and within 1e-9 of exact arithmetic instead of 0.001") ||
                 is_changed;
    is_changed = whole_slider(ui, "scene/samples", "Samples", scene["image"], "samples", 1, 1, 8,
                              "Each pixel is the mean of so many across and down: lines and silhouettes are smooth. Drawn when "
                              "nothing moves, and in saved pictures") ||
                 is_changed;
    return whole_slider(ui, "scene/subdivisions", "Line refinement", scene, "subdivisions", usual_subdivisions, 0, 12,
                        "Contours and mesh lines: how often a pixel is halved at most to decide whether it meets one; more "
                        "leave fewer undecided") ||
           is_changed;
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
            field_choice(ui, "scene/field", "Field", scene, "field", false,
                         "What is shown: a field, or any expression over fields such as norm(grad(p)) / (1 + u[0]^2)"));
        did("colours", edit_color_map(ui, "scene/colors", scene, said<std::string>(scene, "field")));
        ImGui::Separator();
        did("contours", edit_contours(ui, "scene/contours", scene));
        did("mesh lines", edit_mesh_lines(ui, "scene/mesh lines", scene));
        did("streaks", edit_lic(ui, "scene/streaks", scene));
        ImGui::Separator();
        did("light", edit_lighting(ui, scene));
        ImGui::Separator();
        did("threshold",
            text(ui, "scene/threshold", "Only where", scene, "threshold",
                 "The part of the volume that is shown: comparisons of expressions, such as p > 0.2 && x < y", "all"));
        did("displacement", edit_warp(ui, scene));
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
