#include "line_probe.hpp"

#include <core/base/bounds.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elvis::view {

namespace {

/** How far one can go both ways from the middle of the bounds. */
double half_extent_along(const std::array<double, 6>& bounds, const Vector3& direction) {
    double most = HUGE_VAL;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * (bounds[axis + 3] - bounds[axis]);
        // A flat volume ends nothing across itself: the line is laid into it afterwards.
        if (direction[axis] != 0 && half > 0) {
            most = std::min(most, half / std::abs(direction[axis]));
        }
    }
    return std::isfinite(most) ? most : 1;
}

bool is_flat(const VolumeFacts& volume) { return volume.dimension == 2 && volume.bounds[2] == volume.bounds[5]; }

Vector3 laid_into(const VolumeFacts& volume, Vector3 point) {
    point[2] = is_flat(volume) ? volume.bounds[2] : point[2];
    return point;
}

void append_number(std::string& text, double number) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", number);
    text += '\t';
    text += std::isfinite(number) ? digits : "";
}

} // namespace

LineProbe line_across(const VolumeFacts& volume, const Camera& camera) {
    LineProbe line;
    const Vector3 middle = middle_of(volume.bounds);
    const Vector3 right = axes_of(camera).right;
    const Vector3 half = scaled(right, half_extent_along(volume.bounds, right));
    line.from = laid_into(volume, minus(middle, half));
    line.to = laid_into(volume, plus(middle, half));
    if (line.from == line.to) {
        lay_along(line, volume, 0);
    }
    return line;
}

void lay_along(LineProbe& line, const VolumeFacts& volume, std::size_t axis) {
    line.from = line.to = middle_of(volume.bounds);
    line.from[axis] = volume.bounds[axis];
    line.to[axis] = volume.bounds[axis + 3];
}

std::vector<Handle> handles_of(const LineProbe& line) {
    return {{Handle::Kind::free, line.from, {}, std::nullopt, "Drag: move where the line begins", "line from"},
            {Handle::Kind::free, line.to, {}, std::nullopt, "Drag: move where the line ends", "line to"}};
}

LineProbe with_moved_end(const LineProbe& line, const VolumeFacts& volume, std::size_t end, const Vector3& position) {
    LineProbe moved = line;
    (end == 0 ? moved.from : moved.to) = laid_into(volume, position);
    return moved.from == moved.to ? line : moved;
}

LineAnswer answer_of(const LineProbe& line, const commands::SampleTable& table) {
    LineAnswer answer;
    answer.line = line;
    answer.rows = commands::rows_along(table);
    answer.remark = table.no_breaks_because;
    answer.curves = commands::curves_of(table);
    for (const commands::SampledBreak& place : table.breaks) {
        answer.breaks.push_back(place.position);
    }
    return answer;
}

std::string table_text(const LineAnswer& answer) {
    std::string text = "arc_length\tx\ty\tz\telement";
    for (const commands::SampledCurve& curve : answer.curves) {
        text += '\t';
        text += curve.name;
    }
    text += '\n';
    for (const commands::LineRow& row : answer.rows) {
        std::string line;
        append_number(line, row.arc_length);
        for (const double coordinate : row.position) {
            append_number(line, coordinate);
        }
        line += '\t';
        line += row.element >= 0 ? std::to_string(row.element) : std::string();
        for (const double value : row.values) {
            append_number(line, value);
        }
        text.append(line, 1); // Without the first tab.
        text += '\n';
    }
    return text;
}

} // namespace elvis::view
