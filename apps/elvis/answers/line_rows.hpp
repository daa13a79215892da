/**
 * @file line_rows.hpp
 * What a field does along a line, with both of its values wherever an element begins or ends.
 */
#pragma once

#include "sample_table.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace elvis::commands {

/** A point of the line, or one side of a place where an element begins or ends. */
struct LineRow {
    double arc_length = 0;
    std::array<double, 3> position{};
    /** Negative: in no element. */
    std::int64_t element = -1;
    /** As many as a point of the table has; NaN outside. */
    std::vector<double> values;
    /** The second side of such a place. */
    bool is_after = false;
};

/** In the order of the line. Points that fall on a place where an element begins or ends give way to its two sides. */
std::vector<LineRow> rows_along(const SampleTable& table);

} // namespace elvis::commands
