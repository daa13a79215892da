#include <core/arrows/scene_lines.hpp>

#include <core/arrows/scene_places.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace elvis {

namespace {

/** In the middle of boxes that divide the bounds, about as long in each direction. */
std::vector<Vector3> grid_seeds(const std::array<double, 6>& bounds, std::uint32_t n_longest) {
    const Vector3 sides{bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]};
    const double cell = std::max({sides[0], sides[1], sides[2]}) / n_longest;
    std::array<int, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        n[axis] = std::max(1, static_cast<int>(std::lround(sides[axis] / cell)));
    }
    std::vector<Vector3> seeds;
    for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
            for (int i = 0; i < n[0]; ++i) {
                seeds.push_back({bounds[0] + sides[0] * (i + 0.5) / n[0], bounds[1] + sides[1] * (j + 0.5) / n[1],
                                 bounds[2] + sides[2] * (k + 0.5) / n[2]});
            }
        }
    }
    return seeds;
}

const PlacesUse of_streamlines{"streamlines", "begin"};

std::vector<Vector3> line_seeds(const std::array<Vector3, 2>& ends, std::uint32_t n) {
    std::vector<Vector3> seeds;
    for (std::uint32_t i = 0; i < n; ++i) {
        seeds.push_back(plus(ends[0], scaled(minus(ends[1], ends[0]), static_cast<double>(i) / (n - 1))));
    }
    return seeds;
}

std::vector<Vector3> seeds_of(const SceneStreamlines& lines, const Scene& scene, const RuntimeVolume& volume,
                              const std::array<double, 6>& bounds, const TaskControl& control) {
    if (!lines.seeds.empty()) {
        return lines.seeds;
    }
    if (lines.seed_line) {
        return line_seeds(*lines.seed_line, lines.seed_count);
    }
    if (lines.on.empty() && !lines.spacing) {
        return grid_seeds(bounds, lines.seed_grid);
    }
    const double spacing = spacing_of(lines.spacing, bounds);
    std::vector<Vector3> seeds;
    std::ranges::transform(
        scene_places(surface_under(lines.on, scene, of_streamlines), spacing, scene, volume, bounds, of_streamlines, control),
        std::back_inserter(seeds), &ArrowSeed::position);
    return seeds;
}

Flow flow_of(const SceneStreamlines& wanted, const RuntimeVolume& volume, std::uint32_t time_step) {
    if (!wanted.times) {
        return {volume, wanted.flow, time_step};
    }
    const PathlineOptions options{wanted.times->is_linear ? TimeInterpolation::linear : TimeInterpolation::cubic,
                                  wanted.times->start, wanted.times->end};
    return {volume, wanted.flow, pathline_times(volume, static_cast<TraceDirection>(wanted.direction), options)};
}

} // namespace

SceneLines scene_lines(const SceneStreamlines& wanted, const Scene& scene, const RuntimeVolume& volume,
                       const std::array<double, 6>& bounds, const TaskControl& control) {
    need_evaluation(volume);
    TraceOptions options;
    options.direction = static_cast<TraceDirection>(wanted.direction);
    options.tolerance = wanted.tolerance;
    options.most_length = wanted.length.value_or(0);
    const Flow plain = flow_of(wanted, volume, scene.time_step);
    const Flow flow = wanted.ribbon_width ? plain.with_spin() : plain;
    return {flow, trace(flow, seeds_of(wanted, scene, volume, bounds, control), options, control)};
}

std::string lines_key(const SceneStreamlines& lines, const Scene& scene) {
    std::string key = lines.flow + '\n' + (lines.times ? "pathlines" : std::to_string(scene.time_step)) + ' ' +
                      std::to_string(lines.seed_grid) + ' ' + std::to_string(static_cast<int>(lines.direction)) + ' ' +
                      std::to_string(lines.seed_line ? lines.seed_count : 0) + '\n' +
                      places_key(surface_under(lines.on, scene, of_streamlines), scene) + '\n';
    const auto add = [&key](double number) {
        key += ' ';
        key.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    add(lines.length.value_or(0));
    add(lines.tolerance);
    add(lines.ribbon_width.has_value() ? 1 : 0);
    if (lines.times) {
        // What is not said differs from every number.
        add(lines.times->start.value_or(std::nan("")));
        add(lines.times->end.value_or(std::nan("")));
        add(lines.times->is_linear ? 1 : 0);
    }
    add(lines.spacing.value_or(0));
    if (lines.seed_line) {
        std::ranges::for_each((*lines.seed_line)[0], add);
        std::ranges::for_each((*lines.seed_line)[1], add);
    }
    for (const Vector3& seed : lines.seeds) {
        std::ranges::for_each(seed, add);
    }
    return key;
}

} // namespace elvis
