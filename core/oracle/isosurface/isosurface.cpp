#include "isosurface.hpp"

#include <core/base/infinity.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

namespace elvis::oracle {
namespace {

constexpr std::size_t first_degree = 16, last_degree = 128;
// What a series leaves, relative to the field; rounding of evaluation and inversion is a few 1e-15.
constexpr double series_tolerance = 2e-13;
// A value at the end of a segment that is this near to the isovalue, relative to the field's size, is the isovalue.
constexpr double end_rounding = 4e-15;
constexpr std::size_t n_true_samples = 400;
constexpr int n_range_samples = 300;

Vector unit_random(std::mt19937& random) {
    const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1; };
    return {number(), number(), number()};
}

// The interval of t on which a x + b y + c z + d >= 0.
void clip(const Line& line, const std::array<double, 4>& plane, double& from, double& to) {
    const Vector normal(plane[0], plane[1], plane[2]);
    const double slope = normal.dot(line.direction), start = normal.dot(line.origin) + plane[3];
    if (slope > 0)
        from = std::max(from, -start / slope);
    else if (slope < 0)
        to = std::min(to, -start / slope);
    else if (start < 0)
        to = -infinity;
}

} // namespace

Line line_of(const Ray& ray) { return {ray.origin.cast<double>(), ray.direction.cast<double>()}; }

IsosurfaceTracer::IsosurfaceTracer(const Model& model, const Isosurface& isosurface)
    : m_model(model), m_isosurface(isosurface), m_segment_finder(model), m_inverter(model.volume, model.enclosures) {
    std::mt19937 random(1);
    m_low = infinity;
    m_high = -infinity;
    for (std::size_t element = 0; element < model.volume.n_elements(); ++element) {
        const native::Shape shape = model.volume.shape(element);
        for (int i = 0; i < n_range_samples; ++i) {
            const Vector xi = unit_random(random);
            if (excess(shape, xi) > 0)
                continue;
            const double sample = value(element, xi);
            m_low = std::min(m_low, sample);
            m_high = std::max(m_high, sample);
        }
    }
    // Where the field nearly vanishes its rounding is that of what cancels; positions far from the origin are rounded, too.
    const double coordinates = std::max(model.tree.lower().cwiseAbs().maxCoeff(), model.tree.upper().cwiseAbs().maxCoeff());
    m_rounding = 2e-15 * std::max(std::abs(m_low), std::abs(m_high)) + 1e-14 * coordinates / model.diagonal * range();
}

double IsosurfaceTracer::value(std::size_t element, const Vector& xi, Vector* gradient) const {
    if (gradient == nullptr)
        return m_isosurface.scalar(m_model.volume, element, xi, nullptr);
    Vector in_xi;
    const double result = m_isosurface.scalar(m_model.volume, element, xi, &in_xi);
    Matrix jacobian;
    m_model.volume.position(element, xi, &jacobian);
    *gradient = jacobian.transpose().inverse() * in_xi;
    return result;
}

Vector IsosurfaceTracer::follow(std::size_t element, const Vector& x, const Vector& start, Matrix* jacobian) {
    Matrix local;
    Matrix& slope = jacobian != nullptr ? *jacobian : local;
    Vector xi = start;
    for (int turn = 0; turn < 15; ++turn) {
        const Vector residual = x - m_model.volume.position(element, xi, &slope);
        const Vector step = slope.inverse() * residual;
        const double size = step.lpNorm<Eigen::Infinity>();
        if (!(size < 4))
            break;
        xi += step;
        // The error left is about the square of the step.
        if (size < 3e-9)
            return xi;
    }
    for (const double tolerance : {inside_tolerance, 1e-6}) {
        const std::vector<Solution> found = m_inverter.find(element, x, tolerance);
        if (!found.empty()) {
            slope = found.front().jacobian;
            return found.front().xi;
        }
    }
    ++m_failures;
    m_model.volume.position(element, start, &slope);
    return start;
}

std::vector<RaySegment> IsosurfaceTracer::clipped_segments(std::size_t element, const Line& line) {
    std::vector<RaySegment> segments = m_segment_finder.find(element, line, m_inverter);
    if (m_isosurface.clip.empty())
        return segments;
    std::vector<RaySegment> kept;
    for (RaySegment segment : segments) {
        const double middle = 0.5 * (segment.from + segment.to);
        for (const auto& plane : m_isosurface.clip)
            clip(line, plane, segment.from, segment.to);
        if (segment.from >= segment.to)
            continue;
        if (0.5 * (segment.from + segment.to) != middle)
            segment.middle = follow(element, line.at(0.5 * (segment.from + segment.to)), segment.middle);
        kept.push_back(segment);
    }
    return kept;
}

void IsosurfaceTracer::follow_outwards(const Line& line, const RaySegment& segment, std::size_t n, FittedInterval& interval) {
    const double half = 0.5 * (segment.to - segment.from);
    const std::span<const double> points = lobatto_points(n);
    interval.xi.resize(n + 1);
    for (const int way : {1, -1}) {
        Matrix jacobian;
        std::size_t i = n / 2;
        interval.xi[i] = follow(interval.element, line.at(interval.t_of(points[i])), segment.middle, &jacobian);
        while (i != (way > 0 ? n : 0)) {
            const std::size_t next = way > 0 ? i + 1 : i - 1;
            const Vector tangent = jacobian.inverse() * line.direction;
            const Vector start = interval.xi[i] + half * (points[next] - points[i]) * tangent;
            interval.xi[next] = follow(interval.element, line.at(interval.t_of(points[next])), start, &jacobian);
            i = next;
        }
    }
}

void IsosurfaceTracer::add_intervals(std::size_t element, const Line& line, const RaySegment& segment,
                                     std::vector<FittedInterval>& intervals) {
    FittedInterval interval{element, segment.from, segment.to, {}, {}};
    const double half = 0.5 * (segment.to - segment.from);
    std::size_t n = first_degree;
    follow_outwards(line, segment, n, interval);
    std::vector<double> values;
    for (const Vector& xi : interval.xi)
        values.push_back(value(element, xi));
    for (;; n *= 2) {
        interval.field = ChebyshevSeries(values);
        if (interval.field.tail() <= series_tolerance * interval.field.size() + m_rounding) {
            intervals.push_back(std::move(interval));
            return;
        }
        if (n == last_degree)
            break;
        // Every other one of twice as many points is known.
        const std::span<const double> points = lobatto_points(2 * n);
        std::vector<Vector> xi(2 * n + 1);
        std::vector<double> more(2 * n + 1);
        for (std::size_t i = 0; i <= 2 * n; ++i) {
            if (i % 2 == 0) {
                xi[i] = interval.xi[i / 2];
                more[i] = values[i / 2];
            } else {
                xi[i] = follow(element, line.at(interval.t_of(points[i])), interpolate(interval.xi, points[i]));
                more[i] = value(element, xi[i]);
            }
        }
        interval.xi = std::move(xi);
        values = std::move(more);
    }
    // Too short to divide: as good as it gets.
    const double middle = 0.5 * (segment.from + segment.to);
    if (half < 1e-6 * m_model.diagonal) {
        intervals.push_back(std::move(interval));
        return;
    }
    for (const auto& [from, to] : {std::pair(segment.from, middle), std::pair(middle, segment.to)}) {
        const double s = from == segment.from ? -0.5 : 0.5;
        const Vector start = follow(element, line.at(0.5 * (from + to)), interpolate(interval.xi, s));
        add_intervals(element, line, {from, to, start}, intervals);
    }
}

std::vector<FittedInterval> IsosurfaceTracer::intervals(const Line& line, double until) {
    std::vector<FittedInterval> all;
    for (const SegmentFinder::Entry& entry : m_segment_finder.boxes(line)) {
        if (entry.from > until)
            break;
        for (const RaySegment& segment : clipped_segments(entry.element, line))
            add_intervals(entry.element, line, segment, all);
    }
    return all;
}

void IsosurfaceTracer::keep(const Roots& roots, const FittedInterval& interval, std::size_t value, Found& found) const {
    const auto offer = [&](double s) {
        const double t = interval.t_of(s);
        if (!found.first || t < found.first->t)
            found.first = Root{t, value, interpolate(interval.xi, s)};
    };
    if (!roots.at.empty())
        offer(roots.at.front());
    const double rounding = end_rounding * (range() + std::abs(m_isosurface.values[value]));
    for (const Roots::NearMiss& miss : roots.near_misses) {
        const bool is_end = std::abs(miss.at) > 1 - 1e-9;
        if (is_end && std::abs(miss.value) <= rounding)
            offer(miss.at);
        found.near_misses.push_back({interval.t_of(miss.at), std::abs(miss.value), is_end});
    }
}

void IsosurfaceTracer::search(const FittedInterval& interval, RootFinder finder, Found& found) const {
    const std::size_t n = 4 * interval.field.degree();
    std::vector<double> values = interval.field.dense_values();
    for (std::size_t k = 0; k < m_isosurface.values.size(); ++k) {
        const double level = m_isosurface.values[k];
        if (finder == RootFinder::companion) {
            keep({interval.field.companion_roots(level), {}}, interval, k, found);
            continue;
        }
        std::vector<double> differences = values;
        for (double& difference : differences)
            difference -= level;
        keep(find_roots([&](double s) { return interval.field(s); }, level, lobatto_points(n), differences), interval, k,
             found);
    }
}

void IsosurfaceTracer::search_by_samples(std::size_t element, const Line& line, const RaySegment& segment, Found& found) {
    FittedInterval interval{element, segment.from, segment.to, {}, std::vector<Vector>(n_true_samples + 1)};
    const std::span<const double> points = lobatto_points(n_true_samples);
    Vector last = segment.middle;
    for (std::size_t i = n_true_samples / 2; i <= n_true_samples; ++i)
        last = interval.xi[i] = follow(element, line.at(interval.t_of(points[i])), last);
    last = interval.xi[n_true_samples / 2];
    for (std::size_t i = n_true_samples / 2; i-- > 0;)
        last = interval.xi[i] = follow(element, line.at(interval.t_of(points[i])), last);
    const RealFunction field = [&](double s) {
        const auto above = std::lower_bound(points.begin(), points.end(), s) - points.begin();
        const Vector& start = interval.xi[static_cast<std::size_t>(std::min<std::ptrdiff_t>(above, n_true_samples))];
        return value(element, follow(element, line.at(interval.t_of(s)), start));
    };
    for (std::size_t k = 0; k < m_isosurface.values.size(); ++k) {
        std::vector<double> differences;
        for (const Vector& xi : interval.xi)
            differences.push_back(value(element, xi) - m_isosurface.values[k]);
        keep(find_roots(field, m_isosurface.values[k], points, differences), interval, k, found);
    }
}

Crossing IsosurfaceTracer::polish(std::size_t element, const Line& line, const Root& root, double shift) {
    Crossing crossing;
    crossing.element = element;
    crossing.value = root.value;
    crossing.t = root.t;
    crossing.xi = follow(element, line.at(root.t), root.xi);
    Vector gradient;
    const double off = m_isosurface.values[root.value] + shift - value(element, crossing.xi, &gradient);
    // One of Newton's steps takes away what the series leaves; where the ray grazes it would lead astray.
    const double step = off / gradient.dot(line.direction);
    if (std::abs(step) <= 1e-9 * m_model.diagonal) {
        crossing.t += step;
        crossing.xi = follow(element, line.at(crossing.t), crossing.xi);
        value(element, crossing.xi, &gradient);
    }
    crossing.position = line.at(crossing.t);
    crossing.slope = gradient.norm();
    crossing.normal = gradient / crossing.slope;
    const double cosine = crossing.normal.dot(line.direction);
    if (cosine > 0)
        crossing.normal = -crossing.normal;
    crossing.facing = std::abs(cosine);
    return crossing;
}

RayAnswer IsosurfaceTracer::first(const Line& line, RootFinder finder) {
    std::optional<Root> best;
    std::size_t best_element = 0;
    std::vector<Found::NearMiss> near_misses;
    // Elements that share a point find it within rounding of each other.
    const double tie = 1e-13 * (m_model.diagonal + line.origin.norm());
    for (const SegmentFinder::Entry& entry : m_segment_finder.boxes(line)) {
        if (best && entry.from > best->t + tie)
            break;
        Found found;
        for (const RaySegment& segment : clipped_segments(entry.element, line)) {
            if (finder == RootFinder::samples) {
                search_by_samples(entry.element, line, segment, found);
            } else {
                std::vector<FittedInterval> intervals;
                add_intervals(entry.element, line, segment, intervals);
                for (const FittedInterval& interval : intervals) {
                    search(interval, finder, found);
                    if (found.first)
                        break;
                }
            }
            if (found.first)
                break;
        }
        near_misses.insert(near_misses.end(), found.near_misses.begin(), found.near_misses.end());
        if (!found.first)
            continue;
        const auto number = [&](std::size_t element) { return m_model.volume.number(element); };
        if (!best || found.first->t < best->t - tie ||
            (found.first->t <= best->t + tie && number(entry.element) < number(best_element))) {
            best = found.first;
            best_element = entry.element;
        }
    }
    RayAnswer answer;
    for (const Found::NearMiss& miss : near_misses)
        if (!best || (!miss.is_end && miss.t < best->t))
            answer.margin = std::min(answer.margin, miss.size / range());
    if (best)
        answer.crossing = polish(best_element, line, *best);
    return answer;
}

void IsosurfaceTracer::add_roots(const FittedInterval& interval, double shift,
                                 std::vector<std::pair<std::size_t, Root>>& roots) const {
    const std::vector<double> values = interval.field.dense_values();
    for (std::size_t k = 0; k < m_isosurface.values.size(); ++k) {
        const double level = m_isosurface.values[k] + shift;
        std::vector<double> differences = values;
        for (double& difference : differences)
            difference -= level;
        const Roots found = find_roots([&](double s) { return interval.field(s); }, level,
                                       lobatto_points(4 * interval.field.degree()), differences);
        const auto add = [&](double s) {
            roots.push_back({interval.element, {interval.t_of(s), k, interpolate(interval.xi, s)}});
        };
        for (const double s : found.at)
            add(s);
        for (const Roots::NearMiss& miss : found.near_misses)
            if (std::abs(miss.at) > 1 - 1e-9 && std::abs(miss.value) <= end_rounding * (range() + std::abs(level)))
                add(miss.at);
    }
}

std::vector<Crossing> IsosurfaceTracer::all(const Line& line, double shift) {
    std::vector<std::pair<std::size_t, Root>> roots;
    for (const FittedInterval& interval : intervals(line))
        add_roots(interval, shift, roots);
    std::sort(roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.second.t < b.second.t; });
    // As in first().
    const double tie = 1e-13 * (m_model.diagonal + line.origin.norm());
    std::vector<Crossing> crossings;
    double last = -infinity;
    for (const auto& [element, root] : roots) {
        const bool is_tie = root.t <= last + tie && !crossings.empty() && crossings.back().value == root.value &&
                            crossings.back().element != element;
        last = root.t;
        if (is_tie && m_model.volume.number(element) > m_model.volume.number(crossings.back().element))
            continue;
        const Crossing crossing = polish(element, line, root, shift);
        if (is_tie)
            crossings.back() = crossing;
        else
            crossings.push_back(crossing);
    }
    return crossings;
}

IsosurfacePicture draw_isosurface(const Model& model, const Isosurface& isosurface, const Camera& camera, std::uint32_t width,
                                  std::uint32_t height, RootFinder finder) {
    const auto start = std::chrono::steady_clock::now();
    IsosurfacePicture picture;
    picture.answers.resize(std::size_t{width} * height);
    std::vector<IsosurfaceTracer> tracers(std::max(1u, std::thread::hardware_concurrency()),
                                          IsosurfaceTracer(model, isosurface));
    std::atomic<std::uint32_t> next_row = 0;
    {
        std::vector<std::jthread> threads;
        for (IsosurfaceTracer& tracer : tracers)
            threads.emplace_back([&] {
                for (std::uint32_t row = next_row++; row < height; row = next_row++)
                    for (std::uint32_t column = 0; column < width; ++column)
                        picture.answers[std::size_t{row} * width + column] =
                            tracer.first(line_of(pixel_ray(camera, width, height, column, row)), finder);
            });
    }
    picture.range = tracers.front().range();
    for (const IsosurfaceTracer& tracer : tracers)
        picture.n_failures += tracer.n_failures();
    picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

} // namespace elvis::oracle
