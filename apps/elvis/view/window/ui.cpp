#include "ui.hpp"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace elvis::view {

namespace {

/** "u[0]" */
std::string component_name(const std::string& field, std::uint32_t component) {
    std::string name = field;
    name += '[';
    name += std::to_string(component);
    name += ']';
    return name;
}

/** Rounding, beside numbers of an extent, is shown as 0. */
double readable(double value, double extent) { return std::abs(value) < 1e-12 * extent ? 0.0 : value; }

} // namespace

void explain(Ui& ui, const std::string& name, const char* help) {
    const ImVec2 least = ImGui::GetItemRectMin();
    const ImVec2 most = ImGui::GetItemRectMax();
    if (ImGui::IsItemVisible()) {
        ui.places[name] = {least.x, least.y, most.x, most.y};
    }
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || help[0] == '\0') {
        return;
    }
    if (ui.hovered != name) {
        ui.hovered = name;
        ui.hovered_since = ImGui::GetTime();
    }
    constexpr double patience = 0.4; // seconds
    if (ImGui::GetTime() - ui.hovered_since >= patience) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
        ImGui::TextUnformatted(help);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

bool button(Ui& ui, const std::string& name, const char* label, const char* help) {
    const bool is_pressed = ImGui::Button(label);
    explain(ui, name, help);
    return is_pressed;
}

bool small_button(Ui& ui, const std::string& name, const char* label, const char* help) {
    const bool is_pressed = ImGui::SmallButton(label);
    explain(ui, name, help);
    return is_pressed;
}

bool check(Ui& ui, const std::string& name, const char* label, bool& value, const char* help) {
    const bool is_changed = ImGui::Checkbox(label, &value);
    explain(ui, name, help);
    return is_changed;
}

bool number(Ui& ui, const std::string& name, const char* label, double& value, double extent, const char* help) {
    const double before = readable(value, extent);
    double shown = before;
    ImGui::DragScalar(label, ImGuiDataType_Double, &shown, static_cast<float>(std::max(extent, 1e-30) / 400), nullptr, nullptr,
                      "%.6g");
    explain(ui, name, help);
    if (!std::isfinite(shown) || shown == before) {
        return false;
    }
    value = shown;
    return true;
}

bool positive_number(Ui& ui, const std::string& name, const char* label, double& value, double extent, const char* help) {
    double shown = value;
    if (!number(ui, name, label, shown, extent, help) || !(shown > 0)) {
        return false;
    }
    value = shown;
    return true;
}

bool slider(Ui& ui, const std::string& name, const char* label, double& value, double lower, double upper, const char* help) {
    const double before = readable(value, upper - lower);
    double shown = before;
    ImGui::SliderScalar(label, ImGuiDataType_Double, &shown, &lower, &upper, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    explain(ui, name, help);
    if (!std::isfinite(shown) || shown == before) {
        return false;
    }
    value = shown;
    return true;
}

bool vector(Ui& ui, const std::string& name, const char* label, std::array<double, 3>& value, double extent, const char* help) {
    std::array<double, 3> before = value;
    for (double& number : before) {
        number = readable(number, extent);
    }
    std::array<double, 3> shown = before;
    ImGui::DragScalarN(label, ImGuiDataType_Double, shown.data(), 3, static_cast<float>(std::max(extent, 1e-30) / 400), nullptr,
                       nullptr, "%.5g");
    explain(ui, name, help);
    const bool is_finite = std::all_of(shown.begin(), shown.end(), [](double x) { return std::isfinite(x); });
    if (!is_finite || shown == before) {
        return false;
    }
    value = shown;
    return true;
}

bool color(Ui& ui, const std::string& name, const char* label, std::array<double, 3>& rgb, const char* help) {
    std::array<float, 3> shown{};
    std::transform(rgb.begin(), rgb.end(), shown.begin(), [](double x) { return static_cast<float>(x); });
    const bool is_changed = ImGui::ColorEdit3(label, shown.data(), ImGuiColorEditFlags_NoInputs);
    explain(ui, name, help);
    if (is_changed) {
        std::transform(shown.begin(), shown.end(), rgb.begin(), [](float x) { return std::clamp(double{x}, 0.0, 1.0); });
    }
    return is_changed;
}

bool text(Ui& ui, const std::string& name, const char* label, std::string& value, const char* help, const char* hint) {
    const ImGuiID id = ImGui::GetID(label);
    const int frame = ImGui::GetFrameCount();
    // What was being written in a control that has gone meanwhile is forgotten.
    auto written = ui.written.find(id);
    if (written != ui.written.end() && written->second.frame < frame - 1) {
        ui.written.erase(written);
        written = ui.written.end();
    }
    std::string shown = written != ui.written.end() ? written->second.text : value;
    ImGui::InputTextWithHint(label, hint, &shown, ImGuiInputTextFlags_AutoSelectAll);
    const bool is_active = ImGui::IsItemActive();
    explain(ui, name, is_active ? "" : help);
    if (is_active) {
        ui.written[id] = {shown, frame};
        return false;
    }
    if (written == ui.written.end()) {
        return false;
    }
    ui.written.erase(written);
    const bool is_changed = shown != value;
    value = shown;
    return is_changed;
}

double round_middle(const std::array<double, 2>& range) {
    const double middle = 0.5 * (range[0] + range[1]), extent = range[1] - range[0];
    if (!(extent > 0)) {
        return middle;
    }
    const double step = std::pow(10.0, std::floor(std::log10(extent)) - 2);
    const double rounded = std::round(middle / step) * step;
    return std::abs(rounded - middle) < extent ? rounded : middle;
}

bool number_list(Ui& ui, const std::string& name, const char* label, std::vector<double>& values, const char* help) {
    std::string shown;
    for (const double value : values) {
        char one[40];
        std::snprintf(one, sizeof one, "%.9g", value);
        shown += shown.empty() ? "" : " ";
        shown += one;
    }
    if (!text(ui, name, label, shown, help, "0.1 0.2 0.5")) {
        return false;
    }
    std::vector<double> list;
    std::replace(shown.begin(), shown.end(), ',', ' ');
    const char* at = shown.c_str();
    while (true) {
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at) {
            break;
        }
        if (std::isfinite(value)) {
            list.push_back(value);
        }
        at = end;
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    if (list == values) {
        return false;
    }
    values = list;
    return true;
}

bool choice(Ui& ui, const std::string& name, const char* label, std::size_t& chosen, const std::vector<std::string>& words,
            const char* help) {
    bool is_changed = false;
    const bool is_open = ImGui::BeginCombo(label, chosen < words.size() ? words[chosen].c_str() : "");
    explain(ui, name, is_open ? "" : help);
    if (is_open) {
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (ImGui::Selectable(words[i].c_str(), i == chosen) && i != chosen) {
                chosen = i;
                is_changed = true;
            }
            explain(ui, name + "/" + words[i], "");
        }
        ImGui::EndCombo();
    }
    return is_changed;
}

bool offered_text(Ui& ui, const std::string& name, const char* label, std::string& value,
                  const std::vector<std::string>& offers, const char* help) {
    bool is_changed = false;
    ImGui::PushID(name.c_str());
    const float arrow = ImGui::GetFrameHeight();
    std::string typed = value;
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - arrow);
    if (text(ui, name, "##text", typed, help) && !typed.empty()) {
        value = typed;
        is_changed = true;
    }
    ImGui::SameLine(0, 0);
    const bool is_open = ImGui::BeginCombo("##list", nullptr, ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft);
    explain(ui, name + ".list", is_open ? "" : "Fields of the volume, and expressions made of them");
    if (is_open) {
        for (const std::string& offer : offers) {
            if (ImGui::Selectable(offer.c_str(), offer == value) && offer != value) {
                value = offer;
                is_changed = true;
            }
            explain(ui, name + "/" + offer, "");
        }
        ImGui::EndCombo();
    }
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextUnformatted(label);
    ImGui::PopID();
    return is_changed;
}

bool field_choice(Ui& ui, const std::string& name, const char* label, std::optional<std::string>& field, bool may_be_scenes,
                  const char* help) {
    const std::string of_scene = "(the scene's)";
    const std::vector<FieldFacts>& fields = ui.model().volume()->fields;
    std::vector<std::string> offers;
    if (may_be_scenes) {
        offers.push_back(of_scene);
    }
    for (const FieldFacts& info : fields) {
        offers.push_back(info.name);
        for (std::uint32_t c = 0; info.n_components > 1 && c < info.n_components; ++c) {
            offers.push_back(component_name(info.name, c));
        }
    }
    for (const FieldFacts& info : fields) {
        if (info.n_components == 3) {
            offers.push_back("norm(curl(" + info.name + "))");
            offers.push_back("q_criterion(" + info.name + ")");
        } else if (info.n_components == 1) {
            offers.push_back("norm(grad(" + info.name + "))");
        }
    }
    offers.insert(offers.end(), {"scaled_jacobian", "order", "element"});
    const std::string first = fields.empty() ? std::string() : fields.front().name;
    std::string shown = field ? *field : may_be_scenes ? of_scene : first;
    if (!offered_text(ui, name, label, shown, offers, help)) {
        return false;
    }
    field = may_be_scenes && shown == of_scene ? std::nullopt : std::optional(shown);
    return true;
}

} // namespace elvis::view
