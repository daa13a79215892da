#include "panels.hpp"

namespace elvis::view {

bool edit_warp(Ui& ui, Json& scene) {
    const std::vector<std::string> fields = displacements_of(*ui.model().volume());
    const Json start{{"field", fields.empty() ? std::string() : fields.front()}, {"factor", 1}};
    ImGui::BeginDisabled(fields.empty() && !scene.contains("warp"));
    bool is_changed =
        optional_part(ui, "scene/warp", "Displaced", scene, "warp", start, "Every point of the volume is moved by a field");
    ImGui::EndDisabled();
    if (!scene.contains("warp")) {
        return is_changed;
    }
    ImGui::Indent();
    Json& warp = scene["warp"];
    is_changed = choice(ui, "warp/field", "By", warp, "field", fields, "The displacement") || is_changed;
    is_changed =
        number(ui, "warp/factor", "Factor", warp, "factor", 1, 4, "Times which the displacement is taken") || is_changed;
    if (optional_part(ui, "warp/complex", "Complex", warp, "imaginary", warp["field"],
                      "The displacement has an imaginary part, and its phase can be chosen")) {
        warp.erase("phase");
        is_changed = true;
    }
    if (warp.contains("imaginary")) {
        is_changed = choice(ui, "warp/imaginary", "Imaginary", warp, "imaginary", fields, "Its imaginary part") || is_changed;
        is_changed = slider(ui, "warp/phase", "Phase", warp, "phase", 0, 0, 360,
                            "Degrees: the real part of displacement times e^(i phase)") ||
                     is_changed;
    }
    ImGui::Unindent();
    return is_changed;
}

} // namespace elvis::view
