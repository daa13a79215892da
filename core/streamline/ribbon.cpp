#include <core/streamline/ribbon.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Mirrored by the plane across `normal`, of any length but zero. */
Vector3 mirrored(const Vector3& v, const Vector3& normal) {
    return minus(v, scaled(normal, 2 * dot(normal, v) / dot(normal, normal)));
}

/** Of a point of the line. */
struct Frame {
    Vector3 position{};
    /** Of length 1. */
    Vector3 direction{};
};

/**
 * A direction across the line, carried from one point to another by the least rotation: W. Wang et al., "Computation of
 * rotation minimizing frames" (ACM TOG 27, 2008). Of order 4 in the distance.
 */
Vector3 carried(const Vector3& side, const Frame& from, const Frame& to) {
    const Vector3 chord = minus(to.position, from.position);
    if (!(length(chord) > 0)) {
        return side;
    }
    const Vector3 half_way = mirrored(side, chord), direction = mirrored(from.direction, chord);
    const Vector3 rest = minus(to.direction, direction);
    return length(rest) > 0 ? mirrored(half_way, rest) : half_way;
}

Vector3 first_side(const Vector3& direction) {
    // Not by the least component: of several that are zero rounding would decide.
    constexpr double along = 0.9;
    const Vector3 axis = std::abs(direction[2]) < along ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
    return unit(cross(axis, direction));
}

std::vector<Frame> frames_of(const Flow& flow, const Streamline& line) {
    std::vector<Frame> frames;
    for (const TracePoint& point : line.points) {
        const FlowSample sample = flow.at(point.at, point.time - flow.start());
        // Where the flow stands still the line keeps its direction.
        const bool is_still = !(length(sample.velocity) > 0) && !frames.empty();
        frames.push_back({point.position, is_still ? frames.back().direction : unit(sample.velocity)});
    }
    return frames;
}

} // namespace

std::vector<Vector3> ribbon_sides(const Flow& flow, const Streamline& line) {
    const std::vector<Frame> frames = frames_of(flow, line);
    std::vector<Vector3> sides(frames.size());
    const auto seed = static_cast<std::size_t>(
        std::ranges::min_element(line.points, {}, [](const TracePoint& point) { return std::abs(point.arc_length); }) -
        line.points.begin());
    for (std::size_t i = seed; i < sides.size(); ++i) {
        sides[i] = i == seed ? first_side(frames[i].direction) : carried(sides[i - 1], frames[i - 1], frames[i]);
    }
    for (std::size_t i = seed; i-- > 0;) {
        sides[i] = carried(sides[i + 1], frames[i + 1], frames[i]);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const double turn = line.points[i].turn;
        sides[i] = plus(scaled(sides[i], std::cos(turn)), scaled(cross(frames[i].direction, sides[i]), std::sin(turn)));
    }
    return sides;
}

} // namespace elvis
