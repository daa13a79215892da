#include "file_dialog.hpp"

#include <algorithm>
#include <filesystem>

namespace elvis::view {

namespace {

/** Another kind of thing has other endings. */
void fit_ending(const Writable::Kind& kind, std::string& name) {
    const std::filesystem::path path(name);
    const std::vector<const char*>& endings = endings_of(kind);
    if (std::ranges::find(endings, path.extension().string()) == endings.end()) {
        name = std::filesystem::path(path).replace_extension(endings.front()).string();
    }
}

void choose_what(Ui& ui) {
    DialogState& state = ui.dialog_state;
    const std::vector<Writable> all = writables_of(ui.scene(), *ui.model().volume(), ui.bench.line);
    std::vector<std::string> labels;
    for (const Writable& writable : all) {
        labels.push_back(writable.what.of);
    }
    // By its name: while time goes on, all else changes.
    const auto present = std::ranges::find(labels, state.file.what.what.of);
    auto chosen = static_cast<std::size_t>(present == labels.end() ? 0 : present - labels.begin());
    if (choice(ui, "write/what", "What", chosen, labels, "One of what the picture shows, the line, or a grid of points")) {
        fit_ending(all[chosen].kind, state.name);
    }
    state.file.what = all[chosen];
}

void edit_values(Ui& ui, DataFile& file) {
    auto values = static_cast<std::size_t>(file.values);
    if (choice(ui, "write/values", "Values", values, {"none", "of the field shown", "of all fields"},
               "Which values are written beside positions")) {
        file.values = static_cast<WrittenValues>(values);
    }
}

void edit_mesh(Ui& ui, DataFile& file) {
    positive_number(ui, "write/tolerance", "Tolerance", file.tolerance, 0.01,
                    "How far mesh and surface may be from each other, as a share of the volume's diagonal");
    file.tolerance = std::clamp(file.tolerance, 1e-9, 0.5);
    number_list(ui, "write/contours", "Lines at", file.contours,
                "In place of the surface, the lines on it where its field has these values");
}

void edit_grid(Ui& ui, DataFile& file) {
    const char* labels[] = {"x##n", "x##m", "points##k"};
    const char* help[] = {"Points along x", "Points along y", "Points along z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto count = static_cast<int>(file.n_points[axis]);
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
        ImGui::InputInt(labels[axis], &count);
        explain(ui, "write/" + std::to_string(axis), help[axis]);
        constexpr int most_points = 4096;
        file.n_points[axis] = static_cast<std::size_t>(std::clamp(count, 1, most_points));
        if (axis < 2) {
            ImGui::SameLine();
        }
    }
}

void show_progress(Ui& ui) {
    const auto [fraction, activity] = ui.bench.writing().progress();
    ImGui::TextWrapped("Writing %s", ui.dialog_state.file.path.c_str());
    ImGui::ProgressBar(fraction < 0 ? 0 : static_cast<float>(fraction), ImVec2(-1, 0), fraction < 0 ? "" : nullptr);
    ImGui::TextUnformatted(activity.c_str());
    if (button(ui, "dialog/cancel", "Cancel", "Nothing is written")) {
        ui.bench.writing().cancel();
    }
}

} // namespace

void begin_data_file(Ui& ui, const Writable& what, const std::string& stem) {
    DialogState& state = ui.dialog_state;
    state.file = {};
    state.file.what = what;
    state.file.n_points = usual_grid(*ui.model().volume());
    state.name = stem + endings_of(what.kind).front();
}

void write_data_dialog(Ui& ui) {
    DialogState& state = ui.dialog_state;
    DataFile& file = state.file;
    if (ui.bench.writing().is_running()) {
        show_progress(ui);
        return;
    }
    if (!file.path.empty()) {
        ImGui::CloseCurrentPopup(); // It is done, and messages say how.
        return;
    }
    choose_what(ui);
    constexpr float n_lines_below = 6.2f;
    folder_list(ui, n_lines_below);
    edit_values(ui, file);
    if (file.what.kind == Writable::Kind::mesh) {
        edit_mesh(ui, file);
    } else if (file.what.kind == Writable::Kind::grid) {
        edit_grid(ui, file);
    }
    DataFile wanted = file;
    wanted.path = chosen_path(state);
    const std::string problem = problem_of(wanted);
    ImGui::TextUnformatted(problem.c_str());
    bool is_closed = false;
    if (name_and_buttons(ui, "Write", is_closed) && problem.empty()) {
        file.path = wanted.path;
        ui.bench.write_data(file);
    }
    if (is_closed) {
        ImGui::CloseCurrentPopup();
    }
}

} // namespace elvis::view
