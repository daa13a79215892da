#include <core/probe/line_walk.hpp>

#include <core/base/error.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/plate.hpp>
#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

/** Of an element, in reference coordinates: steps along the line, and how far on the next element is looked for. */
constexpr double step_in_element = 0.1;
constexpr double look_ahead = 1e-6;
/** Beyond a face by more than this, a point is outside. */
constexpr double outside = 1e-12;
/** Points of a box of an element that are looked at for where the line enters it. */
constexpr int n_entry_points = 32;

/** The part of the line, from 0 to 1, that lies in the box of an element. */
struct BoxSpan {
    std::uint64_t element = 0;
    double from = 0, to = 0;
};

class Walk {
public:
    Walk(const RuntimeVolume& volume, const Vector3& from, const Vector3& to, const TaskControl* control)
        : m_volume(volume), m_from(from), m_direction(minus(to, from)), m_control(control), m_spans(spans()) {}

    std::vector<LineBreak> breaks();

private:
    /** A point of the line in an element, whose coordinates are those of the solid (plate.hpp). */
    struct Place {
        double t = 0;
        std::uint64_t element = 0;
        Vector3 xi{};
        /** How fast xi changes with t, in the maximum norm. */
        double speed = 0;
    };
    Vector3 point(double t) const { return plus(m_from, scaled(m_direction, t)); }
    std::vector<BoxSpan> spans() const;
    std::optional<Place> in_element(std::uint64_t element, double t) const;
    /** By Newton's method from a point nearby; beyond the shape, too. */
    std::optional<Place> near(const Place& place, double t) const;
    std::optional<Place> holder(double t, double beyond) const;
    std::optional<Place> next_entry(double t) const;
    Place exit_of(Place place) const;
    Place edge_between(Place inside, Place beyond) const;

    const RuntimeVolume& m_volume;
    Vector3 m_from, m_direction;
    const TaskControl* m_control;
    std::vector<BoxSpan> m_spans;
};

/** In the order in which the line comes to the boxes. */
std::vector<BoxSpan> Walk::spans() const {
    const std::vector<double> boxes = all_bounds(m_volume);
    std::vector<BoxSpan> found;
    for (std::uint64_t element = 0; element < m_volume.n_elements(); ++element) {
        BoxSpan span{element, 0, 1};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double slack = 1e-12 * std::max({std::abs(boxes[6 * element + axis]), std::abs(boxes[6 * element + 3 + axis]),
                                                   std::abs(m_from[axis])});
            const double lower = boxes[6 * element + axis] - slack - m_from[axis],
                         upper = boxes[6 * element + 3 + axis] + slack - m_from[axis];
            if (m_direction[axis] == 0) {
                span.to = lower > 0 || upper < 0 ? -1 : span.to;
                continue;
            }
            const double a = lower / m_direction[axis], b = upper / m_direction[axis];
            span.from = std::max(span.from, std::min(a, b));
            span.to = std::min(span.to, std::max(a, b));
        }
        if (span.from <= span.to) {
            found.push_back(span);
        }
    }
    std::ranges::sort(found, [](const BoxSpan& a, const BoxSpan& b) { return a.from < b.from; });
    return found;
}

std::optional<Walk::Place> Walk::in_element(std::uint64_t element, double t) const {
    const SolidElement solid(m_volume, element);
    const Vector3 target = point(t);
    const Inversion found = solid.invert(std::span(&target, 1)).front();
    return found.outcome == Inversion::Outcome::inside ? near({t, element, solid.solid(found.xi), 0}, t) : std::nullopt;
}

std::optional<Walk::Place> Walk::near(const Place& place, double t) const {
    constexpr int most_steps = 20;
    // What rounding of positions leaves.
    constexpr double settled = 1e-13;
    const SolidElement solid(m_volume, place.element);
    const MappingFunction mapping = solid.mapping();
    Place next{t, place.element, place.xi, place.speed};
    for (int step = 0; step < most_steps; ++step) {
        Vector3 position{};
        std::array<double, 9> jacobian{};
        mapping(next.xi, position, jacobian);
        const std::array<double, 9> inverse = invert_matrix(jacobian);
        const Vector3 change = product(inverse, minus(point(t), position));
        next.xi = plus(next.xi, change);
        next.speed = largest(product(inverse, m_direction));
        const double size = largest(change);
        if (!(size < 1)) {
            return std::nullopt;
        }
        if (size < settled) {
            return next;
        }
    }
    return next;
}

/** An element that holds the line at t and, if there is one, a little farther on. */
std::optional<Walk::Place> Walk::holder(double t, double beyond) const {
    std::optional<Place> here;
    for (const BoxSpan& span : m_spans) {
        if (span.from > t + beyond) {
            break;
        }
        if (span.to < t) {
            continue;
        }
        const std::optional<Place> ahead = in_element(span.element, std::min(1.0, t + beyond));
        if (ahead && !here) {
            here = near(*ahead, t);
        }
    }
    return here;
}

/** The next element after a gap, at its edge. */
std::optional<Walk::Place> Walk::next_entry(double t) const {
    std::optional<Place> first;
    for (const BoxSpan& span : m_spans) {
        if (first && span.from >= first->t) {
            break;
        }
        const double from = std::max(span.from, t);
        double last_outside = from;
        for (int i = 1; i <= n_entry_points && span.to > from; ++i) {
            const double at = from + (span.to - from) * i / n_entry_points;
            std::optional<Place> inside = in_element(span.element, at);
            if (!inside) {
                last_outside = at;
                continue;
            }
            for (double below = last_outside; inside->t - below > 1e-15;) {
                const double middle = 0.5 * (inside->t + below);
                const std::optional<Place> there =
                    middle > below && middle < inside->t ? in_element(span.element, middle) : std::nullopt;
                if (there) {
                    inside = there;
                } else if (middle > below && middle < inside->t) {
                    below = middle;
                } else {
                    break;
                }
            }
            if (!first || inside->t < first->t) {
                first = inside;
            }
            break;
        }
    }
    return first;
}

Walk::Place Walk::edge_between(Place inside, Place beyond) const {
    const elvis_shape shape = SolidElement(m_volume, inside.element).shape();
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (inside.t + beyond.t);
        if (!(middle > inside.t && middle < beyond.t)) {
            break;
        }
        const std::optional<Place> there = near(inside, middle);
        if (!there) {
            break;
        }
        (reference_excess(shape, there->xi) > outside ? beyond : inside) = *there;
    }
    return inside;
}

/** The last point of the line in the element that it is in. */
Walk::Place Walk::exit_of(Place place) const {
    const elvis_shape shape = SolidElement(m_volume, place.element).shape();
    double step = step_in_element / place.speed;
    while (place.t < 1) {
        const double t = std::min(1.0, place.t + step);
        const std::optional<Place> next = near(place, t);
        if (!next || largest(minus(next->xi, place.xi)) > 4 * step_in_element) {
            step *= 0.5;
            if (place.t + step <= place.t) {
                return place;
            }
            continue;
        }
        if (reference_excess(shape, next->xi) > outside) {
            return edge_between(place, *next);
        }
        place = *next;
        step = step_in_element / place.speed;
    }
    return place;
}

std::vector<LineBreak> Walk::breaks() {
    std::vector<LineBreak> found;
    const auto reference = [this](const Place& place) {
        return ReferencePoint{place.element, SolidElement(m_volume, place.element).own(place.xi)};
    };
    std::optional<Place> place = holder(0, 1e-9);
    double t = 0;
    if (place) {
        found.push_back({0, std::nullopt, reference(*place)});
    }
    while (t < 1) {
        if (m_control != nullptr) {
            m_control->check();
        }
        if (!place) {
            place = next_entry(t);
            if (!place) {
                break;
            }
            found.push_back({place->t, std::nullopt, reference(*place)});
        }
        const Place exit = exit_of(*place);
        const double beyond = look_ahead / exit.speed;
        place = exit.t < 1 ? holder(exit.t, beyond) : std::nullopt;
        const bool goes_on = place && place->element == exit.element;
        t = goes_on ? exit.t + beyond : exit.t;
        if (goes_on) {
            // It leaves the element for less than what is looked at.
            place = in_element(exit.element, std::min(1.0, t));
            continue;
        }
        found.push_back({exit.t, reference(exit), place ? std::optional(reference(*place)) : std::nullopt});
        t = place ? exit.t : exit.t + beyond;
    }
    return found;
}

/** Whether the volume lies in a plane of constant z, and both points in it. */
bool is_in_plane(const RuntimeVolume& volume, const Vector3& from, const Vector3& to) {
    const std::optional<double> height = flat_height(volume);
    const double most = on_surface * length(minus(to, from));
    return height && std::abs(from[2] - *height) <= most && std::abs(to[2] - *height) <= most;
}

} // namespace

std::vector<LineBreak> walk_line(const RuntimeVolume& volume, const Vector3& from, const Vector3& to,
                                 const TaskControl* control) {
    if (!volume.has_evaluation() || volume.is_cut()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() +
                                       " does not evaluate whole elements on the CPU, along which lines are followed");
    }
    if (volume.dimension() == 2 && !is_in_plane(volume, from, to)) {
        throw Error(volume.path(), "has two dimensions: lines are followed in its plane, if it lies in one of constant z");
    }
    return Walk(volume, from, to, control).breaks();
}

} // namespace elvis
