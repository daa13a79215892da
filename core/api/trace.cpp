#include "call.hpp"
#include "columns.hpp"
#include "drawing.hpp"

#include <core/arrows/scene_lines.hpp>
#include <core/arrows/scene_places.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

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

/** Evenly spaced on the surface that the caller describes. */
void add_seeds_on_surface(const elvis_tracing& tracing, Data& data, std::vector<Vector3>& seeds) {
    if (!(tracing.seed_spacing >= 0 && std::isfinite(tracing.seed_spacing))) {
        throw InvalidArgument("seed_spacing", "is not negative, and finite");
    }
    if (tracing.seed_surface == nullptr) {
        return;
    }
    const auto surface = nlohmann::json::parse(tracing.seed_surface, nullptr, false);
    if (surface.is_discarded()) {
        throw InvalidArgument("seed_surface", "is no JSON");
    }
    Scene scene = scene_of({{"version", 1}, {"surfaces", {surface}}}, "seed_surface");
    scene.time_step = tracing.time_step;
    const std::array<double, 6>& bounds = data.bounds();
    const double spacing = spacing_of(tracing.seed_spacing > 0 ? std::optional(tracing.seed_spacing) : std::nullopt, bounds);
    std::ranges::transform(
        scene_places(&scene.surfaces.at(0), spacing, scene, data.volume, bounds, {"seeds", "lie"}, *data.control),
        std::back_inserter(seeds), &ArrowSeed::position);
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

PathlineOptions pathline_options_of(const elvis_tracing& tracing) {
    if (tracing.interpolation > ELVIS_TIME_LINEAR) {
        throw InvalidArgument("interpolation", "is neither ELVIS_TIME_CUBIC nor ELVIS_TIME_LINEAR");
    }
    PathlineOptions options;
    options.interpolation = static_cast<TimeInterpolation>(tracing.interpolation);
    if ((tracing.flags & ELVIS_TRACE_START_TIME) != 0) {
        options.start = tracing.start_time;
    }
    if ((tracing.flags & ELVIS_TRACE_END_TIME) != 0) {
        options.end = tracing.end_time;
    }
    return options;
}

/** At the points' own times, between time steps as the flow is interpolated. */
std::vector<std::vector<double>> values_in_time(const RuntimeVolume& volume, const Columns& columns, const TimeCourse& course,
                                                const std::vector<ReferencePoint>& points, const std::vector<double>& times) {
    std::vector<std::vector<double>> values(points.size(), std::vector<double>(columns.n_values, 0.0));
    std::vector<TimeWeights> weights;
    for (const double time : times) {
        weights.push_back(course.at(time));
    }
    for (std::uint32_t step = 0; step < volume.times().size(); ++step) {
        std::vector<std::pair<std::size_t, double>> parts;
        std::vector<ReferencePoint> asked;
        for (std::size_t point = 0; point < points.size(); ++point) {
            for (std::size_t i = 0; i < weights[point].count; ++i) {
                if (weights[point].steps[i] == step && weights[point].weights[i] != 0) {
                    parts.emplace_back(point, weights[point].weights[i]);
                    asked.push_back(points[point]);
                }
            }
        }
        const std::vector<std::vector<double>> found = values_at(volume, columns, step, asked);
        for (std::size_t part = 0; part < parts.size(); ++part) {
            for (std::size_t i = 0; i < columns.n_values; ++i) {
                values[parts[part].first][i] += parts[part].second * found[part][i];
            }
        }
    }
    return values;
}

/** Elements' numbers and the columns' values at the points of all lines of the flow. */
void look_up(const Flow& flow, const Columns& columns, std::uint32_t time_step, Lines& lines) {
    const RuntimeVolume& volume = flow.volume();
    std::vector<double> times;
    std::vector<ReferencePoint> points;
    for (const Streamline& line : lines.lines) {
        for (const TracePoint& point : line.points) {
            points.push_back(point.at);
            times.push_back(point.time);
        }
    }
    std::vector<std::int64_t> numbers(volume.n_elements());
    volume.element_numbers(0, numbers.size(), numbers);
    for (const ReferencePoint& point : points) {
        lines.elements.push_back(numbers[point.element]);
    }
    lines.n_values = columns.n_values;
    const std::vector<std::vector<double>> found = flow.is_steady()
                                                       ? values_at(volume, columns, time_step, points)
                                                       : values_in_time(volume, columns, *flow.course(), points, times);
    for (const std::vector<double>& values : found) {
        lines.values.insert(lines.values.end(), values.begin(), values.end());
    }
}

elvis_lines* new_lines(const Data& data, const Flow& flow, std::vector<Streamline> lines, const Columns& columns,
                       std::uint32_t time_step) {
    auto found = std::make_unique<elvis_lines>();
    found->state.context = data.context;
    found->state.lines = std::move(lines);
    look_up(flow, columns, time_step, found->state);
    return found.release();
}

const SceneStreamlines& lines_wanted(const Scene& scene, std::uint32_t surface) {
    if (surface >= scene.surfaces.size() || !scene.surfaces[surface].streamlines) {
        throw InvalidArgument("surface",
                              std::to_string(surface) + " is not the index of streamlines or pathlines of the scene");
    }
    return *scene.surfaces[surface].streamlines;
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
        std::vector<Vector3> seeds = seeds_of(known);
        const TraceOptions options = options_of(known);
        const DataTask running(state, task);
        add_seeds_on_surface(known, state, seeds);
        const Columns columns = columns_of(state.volume, known.fields, known.n_fields);
        const bool is_steady = (known.flags & ELVIS_TRACE_PATHLINES) == 0;
        FlowTimes times;
        if (!is_steady) {
            times = pathline_times(state.volume, options.direction, pathline_options_of(known));
        }
        const Flow flow = is_steady ? Flow(state.volume, known.field, known.time_step) : Flow(state.volume, known.field, times);
        *lines = new_lines(state, flow, trace(flow, seeds, options, *state.control), columns, known.time_step);
    });
}

elvis_result elvis_data_trace_scene(elvis_data* data, const elvis_scene* scene, uint32_t surface, const elvis_string* fields,
                                    uint32_t n_fields, const elvis_task* task, elvis_lines** lines) {
    return call(data, [&] {
        need(lines, "lines");
        *lines = nullptr;
        need(scene, "scene");
        const Scene& said = scene->state.scene;
        const SceneStreamlines& wanted = lines_wanted(said, surface);
        need_one_volume(said, "lines");
        const std::shared_ptr<Data> shown = shown_data(data->state, said, task);
        check_time_step(shown->volume, said.time_step);
        const DataTask running(*shown, task);
        const Columns columns = columns_of(shown->volume, fields, n_fields);
        SceneLines found = scene_lines(wanted, said, shown->volume, shown->bounds(), *shown->control);
        *lines = new_lines(*shown, found.flow, std::move(found.lines), columns, said.time_step);
    });
}

elvis_result elvis_lines_get_info(const elvis_lines* lines, elvis_lines_info* info) {
    return call(lines, [&] {
        elvis_lines_info ours{};
        ours.n_lines = lines->state.lines.size();
        ours.n_points = lines->state.elements.size();
        ours.n_values = lines->state.n_values;
        ours.time_doubt = -1;
        for (const Streamline& line : lines->state.lines) {
            ours.time_doubt = std::max(ours.time_doubt, line.time_doubt);
        }
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
