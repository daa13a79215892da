// Contours, mesh lines and streaks.

#include "panels.hpp"

namespace elvis::view {

namespace {

bool edit_line_style(Ui& ui, const std::string& name, Json& style) {
    bool is_changed = slider(ui, name + "/width", "Width", style, "width", 1, 1, 16, "In pixels");
    is_changed = optional_color(ui, name + "/color", "Own colour", style, "color", {0, 0, 0},
                                "Else black or white, whichever stands out; of mesh lines black") ||
                 is_changed;
    return optional_color(ui, name + "/undecided", "Mark undecided", style, "undecided_color", {1, 0, 1},
                          "Colour of pixels for which it stays open whether they meet a line") ||
           is_changed;
}

/** Round values of the range, so many that divide it evenly, or values of one's own. */
bool edit_values(Ui& ui, const std::string& name, Json& contours) {
    bool is_round = !contours.contains("count") && !contours.contains("values"), is_changed = false;
    if (check(ui, name + "/round", "Round values", is_round, "Some ten round values in the range of the colours")) {
        contours.erase("count");
        contours.erase("values");
        if (!is_round) {
            contours["count"] = 9;
        }
        return true;
    }
    if (is_round) {
        return false;
    }
    int count = contours.value("count", 0);
    if (ImGui::SliderInt("Number", &count, 0, 50, count == 0 ? "given values" : "%d", ImGuiSliderFlags_AlwaysClamp)) {
        contours.erase(count > 0 ? "values" : "count");
        if (count > 0) {
            contours["count"] = count;
        } else {
            contours["values"] = Json::array();
            contours.erase("range");
        }
        is_changed = true;
    }
    explain(ui, name + "/count", "So many that divide the range of the colours evenly; 0 for values of your own");
    if (!contours.contains("count")) {
        is_changed =
            number_list(ui, name + "/values", "Values", contours, "values", "Values of the lines, separated by blanks") ||
            is_changed;
    }
    return is_changed;
}

} // namespace

bool edit_contours(Ui& ui, const std::string& name, Json& owner) {
    ImGui::PushID(name.c_str());
    bool is_changed =
        optional_part(ui, name, "Contours", owner, "contours", Json::object(), "Lines on which the field takes given values");
    if (owner.contains("contours")) {
        ImGui::Indent();
        is_changed = edit_values(ui, name, owner["contours"]) || is_changed;
        is_changed = edit_line_style(ui, name, owner["contours"]) || is_changed;
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

bool edit_mesh_lines(Ui& ui, const std::string& name, Json& owner) {
    ImGui::PushID(name.c_str());
    bool is_changed = optional_part(ui, name, "Mesh lines", owner, "mesh_lines", Json::object(),
                                    "Where the boundaries of elements meet the surface");
    if (owner.contains("mesh_lines")) {
        ImGui::Indent();
        is_changed = edit_line_style(ui, name, owner["mesh_lines"]) || is_changed;
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

bool edit_lic(Ui& ui, const std::string& name, Json& owner) {
    const std::vector<std::string> flows = flows_of(*ui.model().volume());
    if (flows.empty() && !owner.contains("lic")) {
        return false;
    }
    ImGui::PushID(name.c_str());
    bool is_changed = optional_part(ui, name, "Streaks", owner, "lic", Json{{"field", flows.empty() ? "" : flows.front()}},
                                    "Line integral convolution: noise that is averaged along a vector field");
    if (owner.contains("lic")) {
        Json& lic = owner["lic"];
        ImGui::Indent();
        is_changed = offered_text(ui, name + "/field", "Along", lic, "field", flows,
                                  "The vector field or expression whose part in the surface they follow") ||
                     is_changed;
        is_changed = slider(ui, name + "/contrast", "Contrast", lic, "contrast", 0.6, 0, 1, "How dark streaks make colours") ||
                     is_changed;
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

} // namespace elvis::view
