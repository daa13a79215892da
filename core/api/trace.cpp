#include "call.hpp"
#include "columns.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::library {

namespace {

std::vector<Vector3> seeds_of(const elvis_tracing& tracing) {
    if (tracing.n_seeds > 0) {
        need(tracing.seeds, "seeds");
    }
    std::vector<Vector3> seeds;
    for (std::uint64_t i = 0; i < tracing.n_seeds; ++i) {
        const double* const at = tracing.seeds + 3 * i;
        if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2])) {
            throw InvalidArgument("seeds", "seed " + std::to_string(i) + " is not finite");
        }
        seeds.push_back({at[0], at[1], at[2]});
    }
    return seeds;
}

TraceOptions options_of(const elvis_tracing& tracing) {
    if (tracing.direction > ELVIS_LINE_BACKWARD) {
        throw InvalidArgument("direction", "is none of ELVIS_LINE_BOTH, _FORWARD and _BACKWARD");
    }
    if (!(tracing.tolerance >= 0 && tracing.tolerance < 1) || !(tracing.length >= 0)) {
        throw InvalidArgument("tolerance, length", "are not negative, and the tolerance is below 1");
    }
    TraceOptions options;
    options.direction = static_cast<TraceDirection>(tracing.direction);
    options.tolerance = tracing.tolerance > 0 ? tracing.tolerance : options.tolerance;
    options.most_length = tracing.length;
    return options;
}

/** Elements' numbers and the columns' values at the points of all lines. */
void look_up(const RuntimeVolume& volume, const Columns& columns, std::uint32_t time_step, Lines& lines) {
    std::vector<ReferencePoint> points;
    for (const Streamline& line : lines.lines) {
        for (const TracePoint& point : line.points) {
            points.push_back(point.at);
        }
    }
    std::vector<std::int64_t> numbers(volume.n_elements());
    volume.element_numbers(0, numbers.size(), numbers);
    for (const ReferencePoint& point : points) {
        lines.elements.push_back(numbers[point.element]);
    }
    lines.n_values = columns.n_values;
    for (const std::vector<double>& values : values_at(volume, columns, time_step, points)) {
        lines.values.insert(lines.values.end(), values.begin(), values.end());
    }
}

/** Calls visit(number of the point, the point). */
template <class Visit> void for_each_point(const Lines& lines, const Visit& visit) {
    std::size_t index = 0;
    for (const Streamline& line : lines.lines) {
        for (const TracePoint& point : line.points) {
            visit(index++, point);
        }
    }
}

void read_points(const Lines& lines, const elvis_line_arrays& to) {
    for_each_point(lines, [&](std::size_t index, const TracePoint& point) {
        if (to.positions != nullptr) {
            std::ranges::copy(point.position, to.positions + 3 * index);
        }
        if (to.xi != nullptr) {
            std::ranges::copy(point.at.xi, to.xi + 3 * index);
        }
        if (to.times != nullptr) {
            to.times[index] = point.time;
        }
        if (to.arc_lengths != nullptr) {
            to.arc_lengths[index] = point.arc_length;
        }
    });
    if (to.elements != nullptr) {
        std::ranges::copy(lines.elements, to.elements);
    }
    if (to.values != nullptr) {
        std::ranges::copy(lines.values, to.values);
    }
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_trace(elvis_data* data, const elvis_tracing* tracing, const elvis_task* task, elvis_lines** lines) {
    return call(data, [&] {
        need(lines, "lines");
        *lines = nullptr;
        const elvis_tracing known = known_part(tracing, "tracing");
        need(known.field, "field");
        Data& state = *data->state;
        check_time_step(state.volume, known.time_step);
        need_evaluation(state.volume);
        const std::vector<Vector3> seeds = seeds_of(known);
        const TraceOptions options = options_of(known);
        const DataTask running(state, task);
        const Columns columns = columns_of(state.volume, known.fields, known.n_fields);
        const Flow flow(state.volume, known.field, known.time_step);
        auto found = std::make_unique<elvis_lines>();
        found->state.context = state.context;
        found->state.lines = trace(flow, seeds, options, *state.control);
        look_up(state.volume, columns, known.time_step, found->state);
        *lines = found.release();
    });
}

elvis_result elvis_lines_get_info(const elvis_lines* lines, elvis_lines_info* info) {
    return call(lines, [&] {
        elvis_lines_info ours{};
        ours.n_lines = lines->state.lines.size();
        ours.n_points = lines->state.elements.size();
        ours.n_values = lines->state.n_values;
        give(ours, info, "info");
    });
}

elvis_result elvis_lines_read(const elvis_lines* lines, const elvis_line_arrays* arrays) {
    return call(lines, [&] {
        const elvis_line_arrays to = known_part(arrays, "arrays");
        std::uint64_t n_before = 0;
        for (std::size_t index = 0; index < lines->state.lines.size(); ++index) {
            const Streamline& line = lines->state.lines[index];
            if (to.first != nullptr) {
                to.first[index] = n_before;
            }
            if (to.begins != nullptr) {
                to.begins[index] = static_cast<elvis_line_end>(line.begin);
            }
            if (to.ends != nullptr) {
                to.ends[index] = static_cast<elvis_line_end>(line.end);
            }
            n_before += line.points.size();
        }
        if (to.first != nullptr) {
            to.first[lines->state.lines.size()] = n_before;
        }
        read_points(lines->state, to);
    });
}

void elvis_lines_release(elvis_lines* lines) { delete lines; }
