#include "sample_curve.hpp"
#include "line_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::commands {

namespace {

/** Whether two values at one place differ by more than rounding; a NaN differs from all. */
bool is_jump(double before, double after) {
    const double size = std::max(std::abs(before), std::abs(after));
    return !(std::abs(after - before) <= 1e-9 * size);
}

SampledCurve curve_of(const std::vector<LineRow>& rows, const SampledColumn& column, std::uint32_t component) {
    const std::size_t at = column.first + component;
    SampledCurve curve{column.component(component), {}};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        // A jump is a gap, not a steep line.
        if (rows[i].is_after && is_jump(rows[i - 1].values[at], rows[i].values[at])) {
            curve.points.push_back({rows[i].arc_length, std::numeric_limits<double>::quiet_NaN()});
        }
        curve.points.push_back({rows[i].arc_length, rows[i].values[at]});
    }
    return curve;
}

} // namespace

std::vector<SampledCurve> curves_of(const SampleTable& table) {
    const std::vector<LineRow> rows = rows_along(table);
    std::vector<SampledCurve> curves;
    for (const SampledColumn& column : table.columns) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            curves.push_back(curve_of(rows, column, component));
        }
    }
    return curves;
}

} // namespace elvis::commands
