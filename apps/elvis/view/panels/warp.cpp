#include "panels.hpp"

#include <algorithm>

namespace elvis::view {

namespace {

bool choose(Ui& ui, const std::string& name, const char* label, std::string& field, const std::vector<std::string>& fields,
            const char* help) {
    auto chosen = static_cast<std::size_t>(std::ranges::find(fields, field) - fields.begin());
    if (!choice(ui, name, label, chosen, fields, help)) {
        return false;
    }
    field = fields[chosen];
    return true;
}

} // namespace

bool edit_warp(Ui& ui, std::optional<SceneWarp>& warp) {
    const std::vector<std::string> fields = displacements_of(*ui.model().volume());
    bool has_warp = warp.has_value();
    ImGui::BeginDisabled(fields.empty() && !has_warp);
    bool is_changed = check(ui, "scene/warp", "Displaced", has_warp, "Every point of the volume is moved by a field");
    ImGui::EndDisabled();
    if (is_changed) {
        warp.reset();
        if (has_warp) {
            warp = SceneWarp{fields.front(), std::nullopt, 1, 0};
        }
    }
    if (!warp) {
        return is_changed;
    }
    ImGui::Indent();
    is_changed = choose(ui, "warp/field", "By", warp->field, fields, "The displacement") || is_changed;
    is_changed = number(ui, "warp/factor", "Factor", warp->factor, 4, "Times which the displacement is taken") || is_changed;
    bool is_complex = warp->imaginary.has_value();
    if (check(ui, "warp/complex", "Complex", is_complex,
              "The displacement has an imaginary part, and its phase can be chosen")) {
        warp->imaginary = is_complex ? std::optional(warp->field) : std::nullopt;
        warp->phase = is_complex ? warp->phase : 0;
        is_changed = true;
    }
    if (warp->imaginary) {
        is_changed = choose(ui, "warp/imaginary", "Imaginary", *warp->imaginary, fields, "Its imaginary part") || is_changed;
        is_changed = slider(ui, "warp/phase", "Phase", warp->phase, 0, 360,
                            "Degrees: the real part of displacement times e^(i phase)") ||
                     is_changed;
    }
    ImGui::Unindent();
    return is_changed;
}

} // namespace elvis::view
