#include "panels.hpp"

#include <cstdio>

namespace elvis::view {

namespace {

std::string readable_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.8g", value);
    return text;
}

std::string with_error(double value, double error) {
    char text[80];
    std::snprintf(text, sizeof text, "%.17g, off by about %.2g", value, error);
    return text;
}

void line(const char* name, const std::string& words, const std::string& tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(words.c_str());
    if (!tip.empty() && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", tip.c_str());
    }
}

void draw_row(const Numbers& row) {
    line("integral",
         row.integral  ? readable_number(row.integral->value)
         : row.is_done ? "-"
                       : "...",
         row.integral ? with_error(row.integral->value, row.integral->error) : "");
    if (row.integral) {
        const elvis_integral& found = *row.integral;
        line(row.question.domain == ELVIS_DOMAIN_VOLUME ? "volume" : "area", readable_number(found.measure),
             with_error(found.measure, found.measure_error));
        line("mean", found.measure > 0 ? readable_number(found.value / found.measure) : "-", "");
    }
    if (row.extrema) {
        const elvis_range& range = *row.extrema;
        line("minimum", readable_number(range.minimum), place_text(range.minimum_position));
        line("maximum", readable_number(range.maximum), place_text(range.maximum_position));
    }
}

void draw_rows(const std::vector<Numbers>& rows) {
    for (const Numbers& row : rows) {
        ImGui::PushID(&row);
        ImGui::Separator();
        ImGui::TextWrapped("%s: %s", row.question.of.c_str(), row.question.field.c_str());
        if (ImGui::BeginTable("numbers", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
            draw_row(row);
            ImGui::EndTable();
        }
        if (const std::string remark = remark_of(row); !remark.empty()) {
            ImGui::TextWrapped("%s", remark.c_str());
        }
        ImGui::PopID();
    }
}

} // namespace

void draw_numbers(Ui& ui) {
    Workbench& bench = ui.bench;
    if (!ui.model().volume()) {
        return;
    }
    ImGui::TextWrapped(
        "Integrals over the volume and over boundaries, cut planes and isosurfaces that are shown; extrema over the volume.");
    if (bench.is_finding_numbers()) {
        if (button(ui, "numbers/stop", "Stop", "Leaves the rest of the rows empty")) {
            bench.stop_numbers();
        }
    } else if (button(ui, "numbers/find", "Find", "Integrates in double precision, when nothing is being drawn")) {
        bench.find_numbers();
    }
    if (bench.numbers().empty()) {
        return;
    }
    ImGui::SameLine();
    if (button(ui, "numbers/copy", "Copy as table", "To the clipboard, with all digits and errors, separated by tabs")) {
        ImGui::SetClipboardText(table_text(bench.numbers()).c_str());
    }
    if (!bench.has_present_numbers()) {
        ImGui::TextWrapped("The scene has changed since.");
    }
    if (ImGui::BeginChild("rows")) {
        draw_rows(bench.numbers());
    }
    ImGui::EndChild();
}

} // namespace elvis::view
