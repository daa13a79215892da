#include "panels.hpp"

#include <core/base/bounds.hpp>

namespace elvis::view {

namespace {

/** Whether lines are those of one time step, or follow points through time. */
bool edit_times(Ui& ui, Json& lines) {
    const std::vector<double>& times = ui.model().volume()->times;
    bool has_times = lines["type"] == "pathlines";
    if (times.size() < 2 && !has_times) {
        return false;
    }
    bool is_changed =
        check(ui, "streamlines/pathlines", "Pathlines", has_times,
              "The ways of points that move with the field through all time steps; else the lines of this time step");
    if (is_changed) {
        lines["type"] = has_times ? "pathlines" : "streamlines";
        lines["direction"] = has_times ? "forward" : "both";
        for (const char* const key : {"start_time", "end_time", "interpolation"}) {
            lines.erase(key);
        }
    }
    if (!has_times || times.size() < 2) {
        return is_changed;
    }
    const bool goes_back = lines["direction"] == "backward";
    is_changed = slider(ui, "streamlines/start", "Start", lines, "start_time", goes_back ? times.back() : times.front(),
                        times.front(), times.back(), "When points are at their seeds") ||
                 is_changed;
    bool is_linear = lines.value("interpolation", "") == "linear";
    if (check(ui, "streamlines/linear", "Linear in time", is_linear, "Between time steps; else cubic")) {
        lines["interpolation"] = is_linear ? "linear" : "cubic";
        is_changed = true;
    }
    return is_changed;
}

} // namespace

bool edit_streamlines(Ui& ui, Json& lines) {
    const double diagonal = ui.model().volume()->diagonal();
    bool is_changed = offered_text(ui, "streamlines/flow", "Flow", lines, "flow", flows_of(*ui.model().volume()),
                                   "The vector field or expression that the lines follow");
    is_changed = edit_seeds(ui, lines) || is_changed;
    is_changed = edit_times(ui, lines) || is_changed;
    if (choice(ui, "streamlines/direction", "Direction", lines, "direction", {"both", "forward", "backward"},
               "From the seeds: with the flow, against it, or both")) {
        if (lines["direction"] == "both") {
            lines.erase("end_time");
        }
        is_changed = true;
    }
    is_changed = optional_length(ui, "streamlines/ribbons", "Ribbons", lines, "ribbon_width", 0.02 * diagonal, diagonal / 20,
                                 "Ribbons of this width, which turn with the flow; else tubes") ||
                 is_changed;
    if (lines.contains("ribbon_width")) {
        lines.erase("radius");
    } else {
        is_changed = optional_length(ui, "streamlines/radius", "Radius", lines, "radius", 0.004 * diagonal, diagonal / 20,
                                     "Of the tubes; else a small part of the volume's diagonal") ||
                     is_changed;
    }
    return optional_length(ui, "streamlines/length", "Length", lines, "length", diagonal, diagonal,
                           "Of each line, in each direction; else ten times the volume's diagonal") ||
           is_changed;
}

bool edit_arrows(Ui& ui, Json& arrows) {
    const double diagonal = ui.model().volume()->diagonal();
    bool is_changed = offered_text(ui, "arrows/vectors", "Vectors", arrows, "vectors", flows_of(*ui.model().volume()),
                                   "The vector field or expression that the arrows show");
    is_changed = text(ui, "arrows/on", "On", arrows, "on",
                      "Name of the surface on which they stand; in the volume if left empty", "the volume") ||
                 is_changed;
    is_changed = optional_length(ui, "arrows/spacing", "Spacing", arrows, "spacing", 0.05 * diagonal, diagonal / 20,
                                 "Distance between arrows; else a twentieth of the volume's diagonal") ||
                 is_changed;
    return optional_length(ui, "arrows/scale", "Scale", arrows, "scale", 1, 1,
                           "Length of a vector of length 1; else the longest arrow is as long as the spacing") ||
           is_changed;
}

} // namespace elvis::view
