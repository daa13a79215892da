#include "line_plot.hpp"
#include "panels.hpp"

#include <cstdio>

namespace elvis::view {

namespace {

bool edit_ends(Ui& ui, LineProbe& line) {
    const VolumeFacts& volume = *ui.model().volume();
    const double extent = volume.diagonal();
    LineProbe changed = line;
    vector(ui, "line/from", "From", changed.from, extent, "Where the line begins");
    vector(ui, "line/to", "To", changed.to, extent, "Where the line ends");
    const char* labels[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < volume.dimension; ++axis) {
        if (button(ui, std::string("line/") + labels[axis], labels[axis],
                   "Along this axis, through the middle of the volume")) {
            lay_along(changed, volume, axis);
        }
        ImGui::SameLine();
    }
    const std::optional<Picked>& picked = ui.bench.picked();
    ImGui::BeginDisabled(!picked || !picked->is_hit);
    if (button(ui, "line/from point", "From point", "Begins at the point that was clicked on") && picked) {
        changed.from = picked->position;
    }
    ImGui::SameLine();
    if (button(ui, "line/to point", "To point", "Ends at the point that was clicked on") && picked) {
        changed.to = picked->position;
    }
    ImGui::EndDisabled();
    if (changed == line || changed.from == changed.to) {
        return false;
    }
    line = changed;
    return true;
}

/** The row below the cursor, for people. */
void say_row(const LineAnswer& answer, const commands::LineRow& row) {
    ImGui::Text("at %.6g", row.arc_length);
    ImGui::TextWrapped("x = (%.6g, %.6g, %.6g)", row.position[0], row.position[1], row.position[2]);
    if (row.element < 0) {
        ImGui::TextUnformatted("in no element");
        return;
    }
    ImGui::Text("element %lld", static_cast<long long>(row.element));
    for (std::size_t i = 0; i < answer.curves.size() && i < row.values.size(); ++i) {
        ImGui::TextWrapped("%s = %.9g", answer.curves[i].name.c_str(), row.values[i]);
    }
}

} // namespace

void draw_line_probe(Ui& ui) {
    Workbench& bench = ui.bench;
    ui.line_point.reset();
    if (!ui.model().volume()) {
        return;
    }
    if (!bench.line) {
        ImGui::TextWrapped("A field along a straight line, with all jumps between elements.");
        if (button(ui, "line/add", "Lay a line",
                   "Across the picture, through the middle of the volume; its ends can be dragged")) {
            bench.line = line_across(*ui.model().volume(), ui.model().camera());
        }
        return;
    }
    if (edit_ends(ui, *bench.line)) {
        ui.is_dragging = ui.is_dragging || ImGui::IsAnyItemActive();
    }
    field_choice(ui, "line/field", "Field", bench.line->field, true, "Field or expression that is plotted");
    const LineAnswer* const answer = bench.line_answer();
    if (small_button(ui, "line/copy", "Copy as table",
                     "To the clipboard: arc length, position, element and values, separated by tabs") &&
        answer != nullptr) {
        ImGui::SetClipboardText(table_text(*answer).c_str());
    }
    ImGui::SameLine();
    const bool is_removed = small_button(ui, "line/remove", "Remove", "Takes the line away");
    if (answer != nullptr) {
        if (!answer->error.empty() || !answer->remark.empty()) {
            ImGui::TextWrapped("%s", (answer->error.empty() ? answer->remark : answer->error).c_str());
        }
        if (const std::optional<std::size_t> row = draw_line_plot(ui, *answer)) {
            say_row(*answer, answer->rows[*row]);
            ui.line_point = answer->rows[*row].position;
        }
    }
    if (is_removed) {
        bench.line.reset();
    }
}

} // namespace elvis::view
