#include "line_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::commands {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

LineRow side_row(const SampledBreak& place, const std::optional<SampledBreak::Side>& side, std::size_t n_values,
                 bool is_after) {
    LineRow row{place.arc_length, place.position, -1, std::vector<double>(n_values, not_there), is_after};
    if (side) {
        row.element = side->element;
        row.values = side->values;
    }
    return row;
}

} // namespace

std::vector<LineRow> rows_along(const SampleTable& table) {
    std::vector<LineRow> rows;
    const double whole = table.points.arc_lengths.empty() ? 0 : table.points.arc_lengths.back();
    std::size_t next = 0;
    // Places are exact to rounding: a point that is no farther away is not told from one.
    const double same = 1e-12 * whole;
    const auto add_points_before = [&](double end) {
        for (; next < table.points.size() && table.points.arc_lengths[next] < end; ++next) {
            const std::size_t first = next * table.n_values;
            rows.push_back(
                {table.points.arc_lengths[next],
                 {table.points.positions[3 * next], table.points.positions[3 * next + 1], table.points.positions[3 * next + 2]},
                 table.elements[next],
                 {table.values.begin() + static_cast<std::ptrdiff_t>(first),
                  table.values.begin() + static_cast<std::ptrdiff_t>(first + table.n_values)}});
        }
    };
    for (const SampledBreak& place : table.breaks) {
        add_points_before(place.arc_length - same);
        while (next < table.points.size() && table.points.arc_lengths[next] <= place.arc_length + same) {
            ++next;
        }
        rows.push_back(side_row(place, place.before, table.n_values, false));
        rows.push_back(side_row(place, place.after, table.n_values, true));
    }
    add_points_before(std::numeric_limits<double>::infinity());
    return rows;
}

} // namespace elvis::commands
