#include "panels.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

bool edit_seeds(Ui& ui, SceneStreamlines& lines) {
    const VolumeFacts& volume = *ui.model().volume();
    const double extent = volume.diagonal();
    bool is_changed = false;
    bool has_grid = lines.seeds.empty();
    if (check(ui, "streamlines/grid", "Seeds on a grid", has_grid, "Over the volume's bounds; else seeds are single points")) {
        lines.seeds.clear();
        if (!has_grid) {
            const auto& b = volume.bounds;
            lines.seeds.push_back({0.5 * (b[0] + b[3]), 0.5 * (b[1] + b[4]), 0.5 * (b[2] + b[5])});
        }
        is_changed = true;
    }
    if (lines.seeds.empty()) {
        int count = static_cast<int>(lines.seed_grid);
        if (ImGui::SliderInt("Seeds", &count, 1, 30, "%d", ImGuiSliderFlags_AlwaysClamp) &&
            count != static_cast<int>(lines.seed_grid)) {
            lines.seed_grid = static_cast<std::uint32_t>(count);
            is_changed = true;
        }
        explain(ui, "streamlines/count", "Along the longest side of the bounds");
        return is_changed;
    }
    std::optional<std::size_t> removed;
    // Longer lists come from scene files.
    constexpr std::size_t most_shown = 50;
    for (std::size_t i = 0; i < lines.seeds.size() && i < most_shown; ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "streamlines/seed" + std::to_string(i);
        is_changed = vector(ui, name, "##seed", lines.seeds[i], extent, "A point that a line goes through") || is_changed;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "-", "Takes this seed away") && lines.seeds.size() > 1) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        lines.seeds.erase(lines.seeds.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    if (small_button(ui, "streamlines/add", "Add seed", "Near the last one; drag it in the picture")) {
        Vector3 next = lines.seeds.back();
        next[1] += 0.05 * extent;
        lines.seeds.push_back(next);
        is_changed = true;
    }
    const std::optional<Picked>& picked = ui.bench.picked();
    if (picked && picked->is_hit) {
        ImGui::SameLine();
        if (small_button(ui, "streamlines/add point", "Add point", "A seed at the point that was clicked on")) {
            lines.seeds.push_back(picked->position);
            is_changed = true;
        }
    }
    return is_changed;
}

/** A length that may be left to the program. */
bool edit_optional(Ui& ui, const std::string& name, const char* label, std::optional<double>& value, double start,
                   double extent, const char* help) {
    bool has = value.has_value();
    ImGui::PushID(name.c_str());
    bool is_changed = check(ui, name, label, has, help);
    if (is_changed) {
        value = has ? std::optional(start) : std::nullopt;
    }
    if (value) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
        is_changed = positive_number(ui, name + "/value", "##value", *value, extent, help) || is_changed;
    }
    ImGui::PopID();
    return is_changed;
}

/** Whether lines are those of one time step, or follow points through time. */
bool edit_times(Ui& ui, SceneStreamlines& lines) {
    const std::vector<double>& times = ui.model().volume()->times;
    if (times.size() < 2 && !lines.times) {
        return false;
    }
    bool has_times = lines.times.has_value();
    bool is_changed =
        check(ui, "streamlines/pathlines", "Pathlines", has_times,
              "The ways of points that move with the field through all time steps; else the lines of this time step");
    if (is_changed) {
        lines.times = has_times ? std::optional(ScenePathTimes{}) : std::nullopt;
        lines.direction = has_times ? SceneStreamlines::Direction::forward : SceneStreamlines::Direction::both;
    }
    if (!lines.times || times.size() < 2) {
        return is_changed;
    }
    double start =
        lines.times->start.value_or(lines.direction == SceneStreamlines::Direction::backward ? times.back() : times.front());
    if (slider(ui, "streamlines/start", "Start", start, times.front(), times.back(), "When points are at their seeds")) {
        lines.times->start = start;
        is_changed = true;
    }
    return check(ui, "streamlines/linear", "Linear in time", lines.times->is_linear, "Between time steps; else cubic") ||
           is_changed;
}

} // namespace

bool edit_streamlines(Ui& ui, SceneStreamlines& lines) {
    const double diagonal = ui.model().volume()->diagonal();
    bool is_changed = offered_text(ui, "streamlines/flow", "Flow", lines.flow, flows_of(*ui.model().volume()),
                                   "The vector field or expression that the lines follow");
    is_changed = edit_seeds(ui, lines) || is_changed;
    is_changed = edit_times(ui, lines) || is_changed;
    static const std::vector<std::string> words = {"both", "forward", "backward"};
    auto direction = static_cast<std::size_t>(lines.direction);
    if (choice(ui, "streamlines/direction", "Direction", direction, words,
               "From the seeds: with the flow, against it, or both")) {
        lines.direction = static_cast<SceneStreamlines::Direction>(direction);
        if (lines.times && lines.direction == SceneStreamlines::Direction::both) {
            lines.times->end.reset();
        }
        is_changed = true;
    }
    is_changed = edit_optional(ui, "streamlines/radius", "Radius", lines.radius, 0.004 * diagonal, diagonal / 20,
                               "Of the tubes; else a small part of the volume's diagonal") ||
                 is_changed;
    is_changed = edit_optional(ui, "streamlines/length", "Length", lines.length, diagonal, diagonal,
                               "Of each line, in each direction; else ten times the volume's diagonal") ||
                 is_changed;
    return is_changed;
}

} // namespace elvis::view
