#include <core/session/streamline_tubes.hpp>

#include <core/arrows/scene_lines.hpp>
#include <core/base/bounds.hpp>
#include <core/base/counted.hpp>
#include <core/base/log.hpp>
#include <core/streamline/ribbon.hpp>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace elvis {

namespace {

/** More than are in one picture. */
constexpr std::size_t most_known = 32;
/** Of the diagonal. */
constexpr double default_radius = 0.003;

std::string key_of(const SceneStreamlines& lines, const Scene& scene) {
    std::string key = lines_key(lines, scene);
    for (const double size : {lines.radius.value_or(0), lines.ribbon_width.value_or(0)}) {
        key.append(reinterpret_cast<const char*>(&size), sizeof size);
    }
    return key;
}

void say_ends(const char* kind, const std::string& flow, const std::vector<Streamline>& lines) {
    std::size_t n_outside = 0, n_jumps = 0, n_cut_short = 0;
    for (const Streamline& line : lines) {
        n_outside += line.begin == TraceEnd::no_element ? 1 : 0;
        for (const TraceEnd end : {line.begin, line.end}) {
            n_jumps += end == TraceEnd::jump ? 1 : 0;
            n_cut_short += end == TraceEnd::steps ? 1 : 0;
        }
    }
    const LogLevel level = n_jumps + n_cut_short > 0 ? LogLevel::warning : LogLevel::info;
    log_line(level,
             "{} of {}: {}, {} of them with seeds outside of the volume; {} between elements where the field jumps "
             "back, {} by the number of steps",
             kind, flow, counted(lines.size(), "line"), n_outside, counted(n_jumps, "end"), counted(n_cut_short, "end"));
}

TubeSurface tubes_about(const std::vector<Streamline>& lines, double radius) {
    auto tubes = std::make_shared<TubeSet>();
    tubes->radius = radius;
    for (const Streamline& line : lines) {
        std::vector<Vector3> points;
        for (const TracePoint& point : line.points) {
            if (points.empty() || points.back() != point.position) {
                points.push_back(point.position);
            }
        }
        tubes->add(points);
    }
    return {tubes};
}

RibbonSurface ribbons_along(const std::vector<Streamline>& lines, const Flow& flow, double width, const TaskControl& control) {
    auto ribbons = std::make_shared<RibbonSet>();
    ribbons->width = width;
    for (const Streamline& line : lines) {
        control.check();
        std::vector<Vector3> points;
        std::ranges::transform(line.points, std::back_inserter(points), &TracePoint::position);
        ribbons->add(points, ribbon_sides(flow, line));
    }
    return {ribbons};
}

CutShape shape_of(const SceneStreamlines& wanted, const Scene& scene, const RuntimeVolume& volume,
                  const std::array<double, 6>& bounds, const TaskControl& control) {
    const auto [flow, lines] = scene_lines(wanted, scene, volume, bounds, control);
    say_ends(wanted.times ? "pathlines" : "streamlines", wanted.flow, lines);
    if (wanted.ribbon_width) {
        return ribbons_along(lines, flow, *wanted.ribbon_width, control);
    }
    return tubes_about(lines, wanted.radius.value_or(default_radius * diagonal_of(bounds)));
}

bool is_empty(const CutShape& shape) {
    const auto* ribbons = std::get_if<RibbonSurface>(&shape);
    return ribbons != nullptr ? ribbons->ribbons->pieces.empty() : std::get<TubeSurface>(shape).tubes->pieces.empty();
}

} // namespace

void StreamlineTubes::provide(Scene& scene, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                              const TaskControl& control) {
    for (SceneSurface& surface : scene.surfaces) {
        if (!surface.streamlines || !surface.is_shown) {
            continue;
        }
        const std::string key = key_of(*surface.streamlines, scene);
        auto known = m_known.find(key);
        if (known == m_known.end()) {
            if (m_known.size() >= most_known) {
                m_known.clear();
            }
            known = m_known.emplace(key, shape_of(*surface.streamlines, scene, volume, bounds, control)).first;
        }
        surface.geometry = known->second;
        surface.is_shown = !is_empty(known->second);
    }
}

} // namespace elvis
