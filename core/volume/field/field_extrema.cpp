#include <core/base/infinity.hpp>
#include <core/volume/field/field_extrema.hpp>
#include <core/volume/field/weighted_derivatives.hpp>

#include <core/base/vector3.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

namespace elvis {

namespace {

using native::Point;

constexpr std::uint64_t elements_at_once = 16384;
/** Points that may be looked at for one extremum before the bound is left as it is: some seconds. */
constexpr std::uint64_t most_extrema_points = 1u << 22;
/** Boxes are not halved further: their reach is that of rounding. */
constexpr double smallest_half = 0x1p-24;
/** Of sampled elements: those with a sample this near the best one, over the distance of the extrema, are refined. */
constexpr double refined_share = 0.1;
constexpr int refinements = 8;

/** A box in collapsed coordinates of an element, and what the objective is at most in it. */
struct BoundedBox {
    double bound = infinity;
    std::uint64_t element = 0;
    Point middle{};
    double half = 1;

    friend bool operator<(const BoundedBox& a, const BoundedBox& b) { return a.bound < b.bound; }
};

/** What is known of elements before the search: infinity and NaN where the plugin proves nothing. */
struct ElementFacts {
    std::vector<FieldRange> ranges;
    std::vector<DerivativeBounds> derivatives;
};

class Search {
public:
    Search(const RuntimeVolume& volume, std::uint32_t field, int component, std::uint32_t time_step, const TaskControl* control)
        : m_volume(volume), m_field(field), m_time_step(time_step), m_control(control),
          m_n_components(volume.fields()[field].n_components), m_first(component < 0 ? 0u : static_cast<unsigned>(component)),
          m_end(component < 0 ? m_n_components : m_first + 1) {
        read_facts();
        look_at_corners();
    }

    FieldExtrema run() {
        FieldExtremum maximum = largest(1), minimum = largest(-1);
        if (m_is_certified) {
            return {minimum, maximum, ELVIS_CERTIFIED};
        }
        // What was seen on the way to one may be beyond the other.
        maximum = m_best[0];
        minimum = m_best[1];
        return {minimum, maximum, ELVIS_ESTIMATED};
    }

private:
    void read_facts();
    void read_facts_of(std::uint32_t element_class, std::uint64_t first, std::uint64_t count);
    void look_at_corners();
    FieldExtremum largest(int sign);
    std::vector<BoundedBox> octants_of(const BoundedBox& box, int sign);
    std::vector<Point> lattice(const Point& middle, double half, int n) const;
    void sample(std::uint64_t element, int sign);
    void look(std::uint64_t element, std::span<const Point> etas, bool with_gradients);
    double value(std::size_t point) const;
    double reach(std::uint64_t element, std::size_t point, const BoundedBox& box) const;
    double enclosure(std::uint64_t element, int sign) const;
    const DerivativeBounds& derivatives(std::uint64_t element, std::uint32_t component) const {
        return m_facts.derivatives[element * m_n_components + component];
    }
    bool is_bounded(std::uint64_t element) const {
        const bool needs_first = shape_of(element) == native::Shape::pyramid;
        for (std::uint32_t component = m_first; component < m_end; ++component) {
            const DerivativeBounds& bounds = derivatives(element, component);
            if (!std::isfinite(bounds.second) || (needs_first && !std::isfinite(bounds.first))) {
                return false;
            }
        }
        return true;
    }
    native::Shape shape_of(std::uint64_t element) const;
    int lattice_of(std::uint64_t element) const;
    std::uint32_t class_of(std::uint64_t element) const;
    double distance() const { return std::max(0.0, m_best[0].value - m_best[1].value); }
    FieldExtremum& best(int sign) { return m_best[sign > 0 ? 0 : 1]; }

    const RuntimeVolume& m_volume;
    std::uint32_t m_field, m_time_step;
    const TaskControl* m_control;
    std::uint32_t m_n_components, m_first, m_end;
    ElementFacts m_facts;
    /** Maximum, minimum. */
    std::array<FieldExtremum, 2> m_best{FieldExtremum{-infinity, 0, 0, {}}, FieldExtremum{infinity, 0, 0, {}}};
    bool m_is_certified = true;
    std::uint64_t m_n_points = 0;
    /** Of the points looked at last. */
    std::vector<double> m_xi, m_values, m_gradients;
};

void Search::read_facts() {
    const std::uint64_t n = m_volume.n_elements();
    m_facts.ranges.assign(n * m_n_components, {-infinity, infinity});
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    m_facts.derivatives.assign(n * m_n_components, {unknown, unknown});
    for (std::uint32_t element_class = 0; element_class < m_volume.classes().size(); ++element_class) {
        const ClassInfo& info = m_volume.classes()[element_class];
        for (std::uint64_t done = 0; done < info.n_elements; done += elements_at_once) {
            if (m_control) {
                m_control->check();
            }
            read_facts_of(element_class, info.first_element + done, std::min(elements_at_once, info.n_elements - done));
        }
    }
}

void Search::read_facts_of(std::uint32_t element_class, std::uint64_t first, std::uint64_t count) {
    const std::span<FieldRange> ranges = std::span(m_facts.ranges).subspan(first * m_n_components, count * m_n_components);
    if (m_volume.has_field_ranges() && m_volume.field_ranges(m_field, m_time_step, first, count, ranges) != ELVIS_CERTIFIED) {
        std::ranges::fill(ranges, FieldRange{-infinity, infinity});
    }
    std::vector<DerivativeBounds> bounds(count * m_n_components);
    if (read_weighted_derivatives(m_volume, element_class, m_field, m_time_step, first, count, bounds) == ELVIS_CERTIFIED) {
        std::ranges::copy(bounds, m_facts.derivatives.begin() + static_cast<std::ptrdiff_t>(first * m_n_components));
    }
}

/** And at the middle of each element: extrema are often in a corner, and their distance is about known from the start. */
void Search::look_at_corners() {
    std::vector<Point> etas = lattice({}, 1, 2);
    etas.emplace_back();
    for (std::uint64_t element = 0; element < m_volume.n_elements(); ++element) {
        if (m_control && element % elements_at_once == 0) {
            m_control->check();
        }
        look(element, etas, false);
    }
}

std::uint32_t Search::class_of(std::uint64_t element) const {
    const std::vector<ClassInfo>& classes = m_volume.classes();
    const auto next = std::ranges::upper_bound(classes, element, {}, &ClassInfo::first_element);
    return static_cast<std::uint32_t>(next - classes.begin() - 1);
}

native::Shape Search::shape_of(std::uint64_t element) const {
    return static_cast<native::Shape>(m_volume.classes()[class_of(element)].shape);
}

/** Samples along a direction: as many as a polynomial of the field's order can have turns, and three of others. */
int Search::lattice_of(std::uint64_t element) const {
    const ClassFieldInfo info = m_volume.class_field(class_of(element), m_field);
    return std::clamp(1 + *std::max_element(info.order, info.order + 3), 3, 9);
}

/** The objective at a point looked at. */
double Search::value(std::size_t point) const {
    if (m_end == m_first + 1) {
        return m_values[point * m_n_components + m_first];
    }
    double sum = 0;
    for (std::uint32_t component = m_first; component < m_end; ++component) {
        const double u = m_values[point * m_n_components + component];
        sum += u * u;
    }
    return std::sqrt(sum);
}

/** Evaluates at points of an element, and takes note of extreme ones. */
void Search::look(std::uint64_t element, std::span<const Point> etas, bool with_gradients) {
    m_n_points += etas.size();
    m_xi.clear();
    for (const Point& eta : etas) {
        const Point xi = native::expand(shape_of(element), eta);
        m_xi.insert(m_xi.end(), xi.begin(), xi.end());
    }
    m_values.resize(etas.size() * m_n_components);
    m_gradients.resize(with_gradients ? 3 * m_values.size() : 0);
    m_volume.evaluate_field(m_field, m_time_step, element, m_xi, m_values, m_gradients);
    for (std::size_t point = 0; point < etas.size(); ++point) {
        const double here = value(point);
        const FieldExtremum extremum{here, here, element, {m_xi[3 * point], m_xi[3 * point + 1], m_xi[3 * point + 2]}};
        if (std::isfinite(here) && here > m_best[0].value) {
            m_best[0] = extremum;
        }
        if (std::isfinite(here) && here < m_best[1].value) {
            m_best[1] = extremum;
        }
    }
}

/** How far the objective may be, in the box, from its value at the point looked at, which is the box's middle. */
double Search::reach(std::uint64_t element, std::size_t point, const BoundedBox& box) const {
    const native::Shape shape = shape_of(element);
    Vector3 r{};
    // xi is affine in each collapsed coordinate: the corners' images reach furthest.
    for (unsigned corner = 0; corner < 8; ++corner) {
        Point eta = box.middle;
        for (std::size_t d = 0; d < 3; ++d) {
            eta[d] += (corner >> d) & 1u ? box.half : -box.half;
        }
        const Point xi = native::expand(shape, eta);
        for (std::size_t d = 0; d < 3; ++d) {
            r[d] = std::max(r[d], std::abs(xi[d] - m_xi[3 * point + d]));
        }
    }
    const double r_most = std::max({r[0], r[1], r[2]});
    // Second derivatives in pyramids are bounded by B/t.
    const double least_t = shape == native::Shape::pyramid ? 0.5 * (1 - box.middle[2] - box.half) : 1;
    double sum = 0;
    for (std::uint32_t component = m_first; component < m_end; ++component) {
        const double* gradient = &m_gradients[3 * (point * m_n_components + component)];
        const DerivativeBounds& bounds = derivatives(element, component);
        const double curved = std::abs(gradient[0]) * r[0] + std::abs(gradient[1]) * r[1] + std::abs(gradient[2]) * r[2] +
                              0.5 * bounds.second / least_t * r_most * r_most;
        // Near the apex that says nothing.
        const double most = least_t > 0 ? std::min(curved, bounds.first * r_most) : bounds.first * r_most;
        sum += most * most;
    }
    // Evaluations of orders up to 16 are right to 1e-13 of the largest value.
    return std::sqrt(sum) + 1e-13 * std::abs(value(point));
}

/** The objective times the sign is at most this in an element. */
double Search::enclosure(std::uint64_t element, int sign) const {
    const FieldRange* ranges = &m_facts.ranges[element * m_n_components];
    if (m_end == m_first + 1) {
        return sign > 0 ? ranges[m_first].upper : -ranges[m_first].lower;
    }
    double sum = 0;
    for (std::uint32_t component = m_first; component < m_end; ++component) {
        const FieldRange& range = ranges[component];
        const double near = range.lower > 0 ? range.lower : range.upper < 0 ? -range.upper : 0;
        const double far = std::max(std::abs(range.lower), std::abs(range.upper));
        sum += sign > 0 ? far * far : near * near;
    }
    return sign * std::sqrt(sum);
}

/** The box halved in all directions. */
std::vector<BoundedBox> Search::octants_of(const BoundedBox& box, int sign) {
    std::vector<BoundedBox> octants;
    const std::vector<Point> middles = lattice(box.middle, 0.5 * box.half, 2);
    look(box.element, middles, true);
    for (std::size_t which = 0; which < middles.size(); ++which) {
        octants.push_back({box.bound, box.element, middles[which], 0.5 * box.half});
        octants[which].bound = std::min(box.bound, sign * value(which) + reach(box.element, which, octants[which]));
    }
    return octants;
}

/** Points of [-half, half] around the middle, the ends among them, n along each direction; none outside of the cube. */
std::vector<Point> Search::lattice(const Point& middle, double half, int n) const {
    const int depth = m_volume.dimension() == 3 ? n : 1;
    const auto coordinate = [&](std::size_t d, int step) {
        return std::clamp(middle[d] + half * (2.0 * step / (n - 1) - 1), -1.0, 1.0);
    };
    std::vector<Point> points;
    for (int k = 0; k < depth; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                points.push_back({coordinate(0, i), coordinate(1, j), depth > 1 ? coordinate(2, k) : 0});
            }
        }
    }
    return points;
}

/** A lattice over the whole element, then ever smaller ones around the best point. */
void Search::sample(std::uint64_t element, int sign) {
    const int n = lattice_of(element);
    Point middle{};
    double half = 1;
    for (int round = 0; round <= refinements; ++round) {
        const std::vector<Point> etas = lattice(middle, half, n);
        look(element, etas, false);
        double highest = -infinity;
        for (std::size_t point = 0; point < etas.size(); ++point) {
            if (sign * value(point) > highest) {
                highest = sign * value(point);
                middle = etas[point];
            }
        }
        if (!(highest >= sign * best(sign).value - refined_share * distance())) {
            return;
        }
        half *= 2.0 / n;
    }
}

FieldExtremum Search::largest(int sign) {
    std::priority_queue<BoundedBox> boxes;
    for (std::uint64_t element = 0; element < m_volume.n_elements(); ++element) {
        boxes.push({enclosure(element, sign), element, {}, 1});
    }
    m_n_points = 0;
    double bound = -infinity;
    while (!boxes.empty()) {
        if (m_control) {
            m_control->check();
        }
        const BoundedBox box = boxes.top();
        const double enough = sign * best(sign).value + extrema_tolerance * distance();
        if (box.bound <= enough || box.half < smallest_half || m_n_points > most_extrema_points) {
            bound = std::max(bound, box.bound);
            break;
        }
        boxes.pop();
        if (!is_bounded(box.element)) {
            m_is_certified = false;
            sample(box.element, sign);
            continue;
        }
        for (const BoundedBox& octant : octants_of(box, sign)) {
            if (octant.bound > enough) {
                boxes.push(octant);
            } else {
                bound = std::max(bound, octant.bound);
            }
        }
    }
    FieldExtremum result = best(sign);
    result.bound = sign * std::max(bound, sign * result.value);
    return result;
}

} // namespace

FieldExtrema search_extrema(const RuntimeVolume& volume, std::uint32_t field, int component, std::uint32_t time_step,
                            const TaskControl* control) {
    FieldExtrema found = Search(volume, field, component, time_step, control).run();
    if (!std::isfinite(found.minimum.value)) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        found.minimum = found.maximum = {nan, nan, 0, {}};
    }
    return found;
}

std::optional<FieldExtrema> find_extrema(const RuntimeVolume& volume, std::uint32_t field, int component,
                                         std::uint32_t time_step, const TaskControl* control) {
    if (const std::optional<FieldExtrema> known = volume.extrema(field, component, time_step)) {
        return known;
    }
    if (!volume.has_evaluation() || volume.is_cut()) {
        return {};
    }
    return search_extrema(volume, field, component, time_step, control);
}

FieldRange magnitude_range(std::span<const FieldRange> components) {
    double lower = 0, upper = 0;
    for (const FieldRange& range : components) {
        const double near = range.lower > 0 ? range.lower : range.upper < 0 ? -range.upper : 0;
        const double far = std::max(std::abs(range.lower), std::abs(range.upper));
        lower += near * near;
        upper += far * far;
    }
    return {std::sqrt(lower), std::sqrt(upper)};
}

} // namespace elvis
