// Controls of what stands under a key of a part of the scene.

#include "ui.hpp"

namespace elvis::view {

namespace {

/** Lets a control change a copy, and puts it under the key if it did. */
template <class T, class Control> bool changed(Json& part, const char* key, T value, const Control& control) {
    if (!control(value)) {
        return false;
    }
    part[key] = value;
    return true;
}

} // namespace

bool check(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, bool usual, const char* help) {
    return changed(part, key, part.value(key, usual), [&](bool& value) { return check(ui, name, label, value, help); });
}

bool number(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double usual, double extent,
            const char* help) {
    return changed(part, key, part.value(key, usual),
                   [&](double& value) { return number(ui, name, label, value, extent, help); });
}

bool positive_number(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double extent,
                     const char* help) {
    return changed(part, key, part.at(key).get<double>(),
                   [&](double& value) { return positive_number(ui, name, label, value, extent, help); });
}

bool slider(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double usual, double lower,
            double upper, const char* help) {
    return changed(part, key, part.value(key, usual),
                   [&](double& value) { return slider(ui, name, label, value, lower, upper, help); });
}

bool whole_slider(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, int usual, int lower,
                  int upper, const char* help) {
    const bool is_changed = changed(part, key, part.value(key, usual), [&](int& value) {
        return ImGui::SliderInt(label, &value, lower, upper, "%d", ImGuiSliderFlags_AlwaysClamp);
    });
    explain(ui, name, help);
    return is_changed;
}

bool vector(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double extent, const char* help) {
    return changed(part, key, part.at(key).get<Vector3>(),
                   [&](Vector3& value) { return vector(ui, name, label, value, extent, help); });
}

bool color(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const Rgb& usual,
           const char* help) {
    return changed(part, key, part.value(key, usual), [&](Rgb& value) { return color(ui, name, label, value, help); });
}

bool optional_color(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const Rgb& start,
                    const char* help) {
    ImGui::PushID(name.c_str());
    bool is_changed = optional_part(ui, name, label, part, key, start, help);
    // It may be a word.
    if (part_of(part, key).is_array()) {
        ImGui::SameLine();
        is_changed = color(ui, name + ".color", "##color", part, key, start, help) || is_changed;
    }
    ImGui::PopID();
    return is_changed;
}

bool text(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const char* help, const char* hint) {
    auto value = part.value(key, std::string());
    if (!text(ui, name, label, value, help, hint)) {
        return false;
    }
    say(part, key, value.empty() ? std::nullopt : std::optional(value));
    return true;
}

bool number_list(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const char* help) {
    return changed(part, key, part.value(key, std::vector<double>()),
                   [&](std::vector<double>& values) { return number_list(ui, name, label, values, help); });
}

bool choice(Ui& ui, const std::string& name, const char* label, Json& part, const char* key,
            const std::vector<std::string>& words, const char* help) {
    auto chosen = static_cast<std::size_t>(std::ranges::find(words, part.value(key, words.front())) - words.begin());
    if (!choice(ui, name, label, chosen, words, help)) {
        return false;
    }
    part[key] = words[chosen];
    return true;
}

bool offered_text(Ui& ui, const std::string& name, const char* label, Json& part, const char* key,
                  const std::vector<std::string>& offers, const char* help) {
    return changed(part, key, part.at(key).get<std::string>(),
                   [&](std::string& value) { return offered_text(ui, name, label, value, offers, help); });
}

bool field_choice(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, bool may_be_scenes,
                  const char* help) {
    auto field = said<std::string>(part, key);
    if (!field_choice(ui, name, label, field, may_be_scenes, help)) {
        return false;
    }
    say(part, key, field);
    return true;
}

bool optional_part(Ui& ui, const std::string& name, const char* label, Json& whole, const char* key, const Json& start,
                   const char* help) {
    bool has = whole.contains(key);
    if (!check(ui, name, label, has, help)) {
        return false;
    }
    say(whole, key, has ? std::optional(start) : std::nullopt);
    return true;
}

bool optional_length(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double start,
                     double extent, const char* help) {
    ImGui::PushID(name.c_str());
    bool is_changed = optional_part(ui, name, label, part, key, start, help);
    if (part.contains(key)) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
        is_changed = positive_number(ui, name + "/value", "##value", part, key, extent, help) || is_changed;
    }
    ImGui::PopID();
    return is_changed;
}

} // namespace elvis::view
