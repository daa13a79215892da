#include <core/streamline/trace.hpp>

#include <core/base/background.hpp>
#include <core/base/in_parts.hpp>
#include <core/probe/element_finder.hpp>
#include <core/probe/plate.hpp>
#include <core/probe/reference_shape.hpp>
#include <core/streamline/dormand_prince.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

namespace elvis {

namespace {

/** In reference coordinates, where elements are 2 wide: a step at most; beyond a face, what is outside. */
constexpr double longest_step = 0.5;
constexpr double outside = 1e-12;
/** Of the fastest that the line has been. */
constexpr double slowest = 1e-9;
/** One after the other. */
constexpr int most_still_steps = 20;
/** Between two points that are kept. */
constexpr double largest_turn = 3 * 3.14159265358979 / 180;
/** So far ahead a line is looked for in the next element; beyond its face by more, it leads back out. */
constexpr double look_ahead = 1e-6, grazing = 1e-9;

/** Follows one line in one direction. */
class Tracer {
public:
    Tracer(const Flow& flow, const ElementFinder& finder, const TraceOptions& options, const TaskControl& control)
        : m_flow(flow), m_finder(finder), m_options(options), m_control(control),
          m_tolerance(options.tolerance * finder.diagonal()) {}

    /** Without the first point. */
    TraceEnd follow(FlowState state, std::vector<TracePoint>& points);
    /** Of what was followed; see Streamline. */
    double time_doubt() const { return m_doubt > 0 && m_fastest > 0 ? m_doubt / m_fastest : m_doubt; }

private:
    double excess(const FlowState& state) const { return reference_excess(m_flow.shape_of(state.at.element), state.at.xi); }
    double first_step(const FlowState& state) const;
    void note_doubt(const FlowState& state);
    bool is_still(const FlowState& state, double speed) const;
    bool can_shrink(double step, double speed) const;
    FlowStep end_where(const FlowState& start, double step, const std::function<double(const FlowState&)>& beyond) const;
    FlowStep end_on_face(const FlowState& start, FlowStep step) const;
    std::optional<TraceEnd> enter_next(FlowState& state) const;
    bool leads_inside(const FlowState& state) const;
    void keep(const FlowState& from, const FlowState& to, std::vector<TracePoint>& points) const;

    const Flow& m_flow;
    const ElementFinder& m_finder;
    const TraceOptions& m_options;
    const TaskControl& m_control;
    double m_tolerance;
    double m_fastest = 0, m_doubt = -1;
};

void Tracer::note_doubt(const FlowState& state) {
    if (const std::optional<double> doubt = m_flow.interpolation_doubt(state.at, state.time)) {
        m_doubt = std::max(m_doubt, *doubt);
    }
}

/** Nothing moves on there, now or later; what is not a number leads nowhere either. */
bool Tracer::is_still(const FlowState& state, double speed) const {
    const bool has_speed = m_flow.is_steady() ? speed > slowest * m_fastest : std::isfinite(speed);
    return !has_speed || !std::isfinite(largest(state.sample.slope));
}

/** Shorter steps are nothing but rounding. */
bool Tracer::can_shrink(double step, double speed) const {
    return m_flow.is_steady() ? step * speed > 1e-14 * m_finder.diagonal() : step > m_flow.shortest_time();
}

double Tracer::first_step(const FlowState& state) const { return 0.1 * longest_step / largest(state.sample.slope); }

/** The step, shortened until `beyond`, which is negative at its start and positive at its end, is zero: Illinois' method. */
FlowStep Tracer::end_where(const FlowState& start, double step, const std::function<double(const FlowState&)>& beyond) const {
    double low = 0, at_low = beyond(start), high = step;
    FlowStep result = dormand_prince(m_flow, start, step);
    double at_high = beyond(result.end);
    int side = 0;
    for (int iteration = 0; iteration < 60 && high - low > 1e-15 * step; ++iteration) {
        const double between = at_high - at_low > 0 ? high - at_high * (high - low) / (at_high - at_low) : 0;
        const bool is_halved = iteration % 4 == 3 || !(between > low && between < high);
        const double next = is_halved ? 0.5 * (low + high) : between;
        result = dormand_prince(m_flow, start, next);
        const double value = beyond(result.end);
        if (std::abs(value) < 0.5 * outside) {
            break;
        }
        if (value > 0) {
            high = next;
            at_high = value;
            at_low *= side == 1 ? 0.5 : 1;
            side = 1;
        } else {
            low = next;
            at_low = value;
            at_high *= side == -1 ? 0.5 : 1;
            side = -1;
        }
    }
    return result;
}

/** The step, which leaves its element, shortened until it ends on the first face that it crosses. */
FlowStep Tracer::end_on_face(const FlowState& start, FlowStep step) const {
    const elvis_shape shape = m_flow.shape_of(start.at.element);
    // A line may begin on a face that it does not cross: of each face its own distance counts.
    for (int face_count = 0; face_count < 6 && excess(step.end) > outside; ++face_count) {
        const std::array<double, 6> at_end = face_excesses(shape, step.end.at.xi);
        const auto beyond = [&](const FlowState& state) {
            const std::array<double, 6> here = face_excesses(shape, state.at.xi);
            double most = -1;
            for (std::size_t face = 0; face < here.size(); ++face) {
                most = at_end[face] > outside ? std::max(most, here[face] - outside) : most;
            }
            return most;
        };
        step = end_where(start, step.end.time - start.time, beyond);
    }
    return step;
}

bool Tracer::leads_inside(const FlowState& state) const {
    const double speed = largest(state.sample.slope);
    if (!(speed > 0)) {
        return true;
    }
    const Vector3 ahead = plus(state.at.xi, scaled(state.sample.slope, look_ahead / speed));
    return reference_excess(m_flow.shape_of(state.at.element), ahead) <= grazing;
}

/** From a point on a face into the element that the field leads into; or why there is none. */
std::optional<TraceEnd> Tracer::enter_next(FlowState& state) const {
    bool has_other = false;
    for (const ReferencePoint& there : m_finder.holders(m_flow.volume(), state.sample.position)) {
        has_other = has_other || there.element != state.at.element;
        FlowState next = state;
        next.at = {there.element, there.xi};
        next.sample = m_flow.at(next.at, state.time);
        if (leads_inside(next)) {
            state = next;
            return std::nullopt;
        }
    }
    return has_other ? TraceEnd::jump : TraceEnd::left_volume;
}

/** The end of a step, and points between that follow how the line bends. */
void Tracer::keep(const FlowState& from, const FlowState& to, std::vector<TracePoint>& points) const {
    const double speeds = length(from.sample.velocity) * length(to.sample.velocity);
    const double cosine = speeds > 0 ? dot(from.sample.velocity, to.sample.velocity) / speeds : 1;
    const double turn = std::max(std::acos(std::clamp(cosine, -1.0, 1.0)), std::abs(to.turn - from.turn));
    const auto n_pieces = static_cast<int>(std::ceil(turn / largest_turn + 1e-9));
    const double step = to.time - from.time;
    for (int piece = 1; piece < n_pieces; ++piece) {
        // Cubic Hermite interpolation of the reference coordinates and of the turn.
        const double s = static_cast<double>(piece) / n_pieces, t = 1 - s;
        TracePoint point;
        point.at.element = from.at.element;
        point.at.xi = plus(plus(scaled(from.at.xi, t * t * (1 + 2 * s)), scaled(to.at.xi, s * s * (1 + 2 * t))),
                           scaled(minus(scaled(from.sample.slope, t), scaled(to.sample.slope, s)), s * t * step));
        m_flow.volume().evaluate_mapping(point.at.element, point.at.xi, point.position, {});
        point.time = from.time + s * step;
        point.arc_length = std::lerp(from.arc_length, to.arc_length, s);
        point.turn = from.turn * t * t * (1 + 2 * s) + to.turn * s * s * (1 + 2 * t) +
                     (from.sample.spin * t - to.sample.spin * s) * s * t * step;
        points.push_back(point);
    }
    points.push_back({to.at, to.sample.position, to.time, to.arc_length, to.turn});
}

TraceEnd Tracer::follow(FlowState state, std::vector<TracePoint>& points) {
    double step = 0;
    int n_still = 0;
    m_fastest = length(state.sample.velocity);
    for (std::uint32_t n_steps = 0; n_steps < m_options.most_steps; ++n_steps) {
        m_control.check();
        const double speed = length(state.sample.velocity);
        m_fastest = std::max(m_fastest, speed);
        if (is_still(state, speed)) {
            return TraceEnd::stagnation;
        }
        const std::optional<double> stop = m_flow.next_stop(state.time);
        if (!stop) {
            return TraceEnd::time;
        }
        step = step > 0 ? std::min(step, longest_step / largest(state.sample.slope)) : first_step(state);
        const bool reaches_stop = step >= *stop - state.time;
        const double without_stop = step;
        step = std::min(step, *stop - state.time);
        FlowStep next = dormand_prince(m_flow, state, step);
        const double ratio = std::max(next.error / m_tolerance, std::abs(next.turn_error) / m_options.tolerance);
        if (!(ratio <= 1) && can_shrink(step, speed)) {
            step *= ratio > 0 ? std::max(0.2, 0.9 * std::pow(ratio, -0.2)) : 0.2;
            continue;
        }
        const bool is_too_long = next.end.arc_length > m_options.most_length;
        if (is_too_long) {
            next = end_where(state, step, [&](const FlowState& at) {
                return (at.arc_length - m_options.most_length) / m_finder.diagonal();
            });
        }
        const bool leaves = excess(next.end) > outside;
        if (leaves) {
            next = end_on_face(state, next);
        }
        note_doubt(state);
        // It moves by no more than its error.
        const bool is_at_rest = length(minus(next.end.sample.position, state.sample.position)) < 10 * m_tolerance;
        n_still = is_at_rest && m_flow.is_steady() ? n_still + 1 : 0;
        keep(state, next.end, points);
        state = next.end;
        if (n_still > most_still_steps) {
            return TraceEnd::stagnation;
        }
        if (leaves) {
            if (const std::optional<TraceEnd> end = enter_next(state)) {
                return *end;
            }
            step = 0;
            continue;
        }
        if (is_too_long) {
            return TraceEnd::length;
        }
        step *= std::clamp(0.9 * std::pow(std::max(ratio, 1e-10), -0.2), 0.2, 5.0);
        if (reaches_stop) {
            state.time = *stop;
            step = std::max(step, without_stop);
        }
    }
    return TraceEnd::steps;
}

/** A line that was followed upstream, in the order of time. */
std::vector<TracePoint> turned_round(std::vector<TracePoint> points) {
    std::ranges::reverse(points);
    for (TracePoint& point : points) {
        point.time = -point.time;
        point.arc_length = -point.arc_length;
    }
    return points;
}

Streamline line_from(const Vector3& seed, const Flow& flow, const Flow& reversed, const ElementFinder& finder,
                     const TraceOptions& options, const TaskControl& control) {
    Streamline line;
    const std::vector<ReferencePoint> holders = finder.holders(flow.volume(), seed);
    if (holders.empty()) {
        line.begin = line.end = TraceEnd::no_element;
        return line;
    }
    // On a face each direction begins where it leads into.
    const auto follow = [&](const Flow& along, std::vector<TracePoint>& points) {
        FlowState start{holders.front(), along.at(holders.front(), 0), 0, 0, 0};
        Tracer tracer(along, finder, options, control);
        for (const ReferencePoint& holder : holders) {
            const FlowState other{holder, along.at(holder, 0), 0, 0, 0};
            const double speed = largest(other.sample.slope);
            const Vector3 ahead = plus(holder.xi, scaled(other.sample.slope, speed > 0 ? look_ahead / speed : 0));
            if (reference_excess(along.shape_of(holder.element), ahead) <= grazing) {
                start = other;
                break;
            }
        }
        const TraceEnd end = tracer.follow(start, points);
        line.time_doubt = std::max(line.time_doubt, tracer.time_doubt());
        return end;
    };
    const FlowSample sample = flow.at(holders.front(), 0);
    if (options.direction != TraceDirection::forward) {
        std::vector<TracePoint> upstream;
        line.begin = follow(reversed, upstream);
        line.points = turned_round(std::move(upstream));
    }
    line.points.push_back({holders.front(), sample.position, 0, 0, 0});
    if (options.direction != TraceDirection::backward) {
        line.end = follow(flow, line.points);
    }
    for (TracePoint& point : line.points) {
        point.time += flow.start();
    }
    return line;
}

} // namespace

std::vector<Streamline> trace(const Flow& flow, std::span<const Vector3> seeds, const TraceOptions& options,
                              const TaskControl& control) {
    const ElementFinder finder(flow.volume());
    const Flow reversed = flow.reversed();
    TraceOptions own = options;
    if (!(options.most_length > 0)) {
        own.most_length = flow.is_steady() ? 10 * finder.diagonal() : std::numeric_limits<double>::infinity();
    }
    std::vector<Streamline> lines(seeds.size());
    Background background(std::max(1u, std::thread::hardware_concurrency()));
    const std::uint64_t part = flow.is_one_at_a_time() ? std::max<std::uint64_t>(1, seeds.size()) : 1;
    std::atomic<std::uint64_t> n_done = 0;
    const auto check = [&] {
        control.check();
        control.progress(static_cast<double>(n_done.load()) / static_cast<double>(seeds.size()),
                         flow.is_steady() ? "streamlines" : "pathlines");
    };
    in_parts(
        background, seeds.size(), part,
        [&](std::uint64_t first, std::uint64_t count) {
            for (std::uint64_t i = first; i < first + count; ++i) {
                lines[i] = line_from(seeds[i], flow, reversed, finder, own, control);
                ++n_done;
            }
        },
        check);
    return lines;
}

} // namespace elvis
