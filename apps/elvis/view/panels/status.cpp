#include "panels.hpp"

#include <cstdio>

namespace elvis::view {

void draw_status(Ui& ui) {
    const Workbench& bench = ui.bench;
    std::string text;
    const std::string activity = bench.activity();
    if (ui.bench.conversion().is_running()) {
        const auto [fraction, what] = ui.bench.conversion().progress();
        char part[40];
        std::snprintf(part, sizeof part, "%.0f %%", 100 * fraction);
        text = "converting: " + what + (fraction >= 0 ? std::string(" ") + part : std::string());
    } else if (!activity.empty()) {
        text = activity + " ...";
    } else if (!bench.messages().empty()) {
        text = bench.messages().back().text;
    }
    const bool is_error = activity.empty() && !bench.messages().empty() && text == bench.messages().back().text &&
                          bench.messages().back().kind == Message::Kind::error;
    if (is_error) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.45f, 0.4f, 1.0f));
    }
    ImGui::TextUnformatted(text.c_str());
    if (is_error) {
        ImGui::PopStyleColor();
    }
    explain(ui, "status", text.c_str());
    char right[120] = "";
    if (bench.picture().width > 0) {
        const auto [width, height] = size_of(ui.scene());
        std::snprintf(right, sizeof right, "%u x %u   %.0f ms", width, height, bench.picture().milliseconds);
    }
    const float width = ImGui::CalcTextSize(right).x;
    ImGui::SameLine(ImGui::GetWindowWidth() - width - ImGui::GetStyle().WindowPadding.x);
    ImGui::TextUnformatted(right);
    explain(ui, "status/picture", "Size of the picture, and the time that the last one took");
}

void draw_time(Ui& ui) {
    const std::vector<double>& times = ui.model().volume()->times;
    int step = static_cast<int>(time_step_of(ui.scene()));
    const int last = static_cast<int>(times.size()) - 1;
    const auto go_to = [&](int to) {
        Scene scene = ui.scene();
        scene["volume"]["time_step"] = to;
        ui.model().edit("time step", std::move(scene));
    };
    if (button(ui, "time/play", ui.is_playing ? "Stop" : "Play", "Shows one time step after the other")) {
        ui.is_playing = !ui.is_playing;
    }
    ImGui::SameLine();
    if (button(ui, "time/back", "<", "One step back") && step > 0) {
        go_to(step - 1);
    }
    ImGui::SameLine();
    if (button(ui, "time/on", ">", "One step on") && step < last) {
        go_to(step + 1);
    }
    ImGui::SameLine();
    char text[60];
    std::snprintf(text, sizeof text, "%%d of %d: t = %.6g", last, times[static_cast<std::size_t>(step)]);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##step", &step, 0, last, text, ImGuiSliderFlags_AlwaysClamp)) {
        go_to(step);
    }
    explain(ui, "time/step", "The time step that is shown");
    if (ui.is_playing && ui.bench.has_shown_present()) {
        go_to(step < last ? step + 1 : 0);
        ui.model().end_gesture();
    }
}

} // namespace elvis::view
