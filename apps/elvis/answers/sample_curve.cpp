#include "sample_curve.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::commands {

namespace {

SampledCurve curve_of(const SampleTable& table, const SampledColumn& column, std::uint32_t component) {
    struct Knot {
        double arc_length = 0;
        /** Of several at one place. */
        int rank = 0;
        double value = 0;
    };
    const std::size_t at = column.first + component;
    std::vector<Knot> knots;
    for (std::size_t point = 0; point < table.points.size(); ++point) {
        knots.push_back({table.points.arc_lengths[point], 1, table.values[point * table.n_values + at]});
    }
    for (const SampledBreak& each : table.breaks) {
        const double before = each.before ? each.before->values[at] : std::nan("");
        const double after = each.after ? each.after->values[at] : std::nan("");
        // A jump is a gap, not a steep line.
        const double size = std::max(std::abs(before), std::abs(after));
        const bool is_jump = !(std::abs(after - before) <= 1e-9 * size);
        knots.push_back({each.arc_length, 0, before});
        if (is_jump) {
            knots.push_back({each.arc_length, 1, std::nan("")});
        }
        knots.push_back({each.arc_length, 2, after});
    }
    std::ranges::stable_sort(knots, [](const Knot& a, const Knot& b) {
        return a.arc_length != b.arc_length ? a.arc_length < b.arc_length : a.rank < b.rank;
    });
    SampledCurve curve{column.component(component), {}};
    for (const Knot& knot : knots) {
        curve.points.push_back({knot.arc_length, knot.value});
    }
    return curve;
}

} // namespace

std::vector<SampledCurve> curves_of(const SampleTable& table) {
    std::vector<SampledCurve> curves;
    for (const SampledColumn& column : table.columns) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            curves.push_back(curve_of(table, column, component));
        }
    }
    return curves;
}

} // namespace elvis::commands
