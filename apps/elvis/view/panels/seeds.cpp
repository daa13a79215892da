#include "panels.hpp"

#include <core/base/bounds.hpp>

#include <algorithm>

namespace elvis::view {

namespace {

/** Where seeds are: each kind has keys of its own, which exclude those of the others. */
constexpr std::array<const char*, 6> keys = {"seeds", "seed_line", "seed_count", "seed_grid", "on", "spacing"};
enum Kind : std::size_t { on_a_grid, points, on_a_line, evenly };

Kind kind_of(const Json& lines) {
    return lines.contains("seeds")                             ? points
           : lines.contains("seed_line")                       ? on_a_line
           : lines.contains("on") || lines.contains("spacing") ? evenly
                                                               : on_a_grid;
}

void begin_kind(Kind kind, const VolumeFacts& volume, Json& lines) {
    std::ranges::for_each(keys, [&](const char* key) { lines.erase(key); });
    const Vector3 middle = middle_of(volume.bounds);
    if (kind == points) {
        lines["seeds"] = {middle};
    } else if (kind == on_a_line) {
        const double reach = 0.2 * volume.diagonal();
        lines["seed_line"] = {plus(middle, {0, -reach, 0}), plus(middle, {0, reach, 0})};
    } else if (kind == evenly) {
        lines["spacing"] = 0.1 * volume.diagonal();
    }
}

bool edit_points(Ui& ui, double extent, Json& lines) {
    auto seeds = lines["seeds"].get<std::vector<Vector3>>();
    bool is_changed = false;
    std::optional<std::size_t> removed;
    // Longer lists come from scene files.
    constexpr std::size_t most_shown = 50;
    for (std::size_t i = 0; i < seeds.size() && i < most_shown; ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "streamlines/seed" + std::to_string(i);
        is_changed = vector(ui, name, "##seed", seeds[i], extent, "A point that a line goes through") || is_changed;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "-", "Takes this seed away") && seeds.size() > 1) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        seeds.erase(seeds.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    if (small_button(ui, "streamlines/add", "Add seed", "Near the last one; drag it in the picture")) {
        Vector3 next = seeds.back();
        next[1] += 0.05 * extent;
        seeds.push_back(next);
        is_changed = true;
    }
    const std::optional<Picked>& picked = ui.bench.picked();
    if (picked && picked->is_hit) {
        ImGui::SameLine();
        if (small_button(ui, "streamlines/add point", "Add point", "A seed at the point that was clicked on")) {
            seeds.push_back(picked->position);
            is_changed = true;
        }
    }
    if (is_changed) {
        lines["seeds"] = seeds;
    }
    return is_changed;
}

bool edit_line(Ui& ui, double extent, Json& lines) {
    auto ends = lines["seed_line"].get<std::array<Vector3, 2>>();
    bool is_changed = vector(ui, "streamlines/from", "From", ends[0], extent, "One end of the line of seeds");
    is_changed = vector(ui, "streamlines/to", "To", ends[1], extent, "Its other end") || is_changed;
    if (is_changed) {
        lines["seed_line"] = ends;
    }
    return whole_slider(ui, "streamlines/line count", "Seeds", lines, "seed_count", 20, 2, 200, "Evenly spaced on the line") ||
           is_changed;
}

} // namespace

bool edit_seeds(Ui& ui, Json& lines) {
    const VolumeFacts& volume = *ui.model().volume();
    const double extent = volume.diagonal();
    auto kind = static_cast<std::size_t>(kind_of(lines));
    if (choice(ui, "streamlines/seeds", "Seeds", kind, {"on a grid", "points", "on a line", "evenly"},
               "Where lines begin: over the volume's bounds, at single points, on a line, or evenly on a surface or in the "
               "volume")) {
        begin_kind(static_cast<Kind>(kind), volume, lines);
        return true;
    }
    if (kind == points) {
        return edit_points(ui, extent, lines);
    }
    if (kind == on_a_line) {
        return edit_line(ui, extent, lines);
    }
    if (kind == on_a_grid) {
        return whole_slider(ui, "streamlines/count", "Count", lines, "seed_grid", 5, 1, 30,
                            "Along the longest side of the bounds");
    }
    const bool is_changed = text(ui, "streamlines/on", "On", lines, "on",
                                 "Name of the surface on which lines begin; in the volume if left empty", "the volume");
    return optional_length(ui, "streamlines/spacing", "Spacing", lines, "spacing", 0.1 * extent, extent / 20,
                           "Distance between seeds; else a twentieth of the volume's diagonal") ||
           is_changed;
}

} // namespace elvis::view
