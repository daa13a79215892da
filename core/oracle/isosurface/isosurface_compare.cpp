#include "isosurface_compare.hpp"

#include <core/base/infinity.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace elvis::oracle {
namespace {

// Bits by which a pixel says that what it shows may not be right.
constexpr std::uint32_t uncertain =
    pixel_flag::isosurface_undecided | pixel_flag::newton_failure | pixel_flag::undecided | pixel_flag::work_limit;
// Depths farther apart than this belong to different sheets of a surface.
constexpr double same_sheet = 1e-3;

Vector normal_of(const Frame& frame, std::size_t pixel) {
    return {frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]};
}

} // namespace

double IsosurfaceJudge::certain_crossing(const std::vector<FittedInterval>& intervals, double value) const {
    const double room = m_tolerance.field * m_tracer.range();
    int side = 0;
    const FittedInterval* previous = nullptr;
    for (const FittedInterval& interval : intervals) {
        const double start = interval.field(-1) - value;
        const bool continues =
            previous != nullptr && std::abs(interval.from - previous->to) <= length(interval.from) &&
            (interval.element == previous->element || std::abs(start - (previous->field(1) - value)) <= room);
        if (!continues)
            side = 0;
        previous = &interval;

        struct Event {
            double t;
            int side;
        };
        std::vector<Event> events;
        if (std::abs(start) > room)
            events.push_back({interval.from, start > 0 ? 1 : -1});
        const std::span<const double> points = lobatto_points(4 * interval.field.degree());
        for (const int way : {1, -1}) {
            const double level = value + way * room;
            std::vector<double> differences = interval.field.dense_values();
            for (double& difference : differences)
                difference -= level;
            for (const double s : find_roots([&](double at) { return interval.field(at); }, level, points, differences).at)
                events.push_back({interval.t_of(s), way});
        }
        std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
        for (const Event& event : events) {
            if (side == -event.side)
                return event.t;
            side = event.side;
        }
    }
    return infinity;
}

bool IsosurfaceJudge::is_on_surface(const std::vector<FittedInterval>& intervals, double depth) const {
    const double along = length(depth), room = m_tolerance.field * m_tracer.range();
    return std::ranges::any_of(intervals, [&](const FittedInterval& interval) {
        if (depth < interval.from - along || depth > interval.to + along)
            return false;
        const auto value_at = [&](double t) {
            return interval.field(std::clamp((2 * t - interval.from - interval.to) / (interval.to - interval.from), -1.0, 1.0));
        };
        const double before = value_at(depth - along), here = value_at(depth), after = value_at(depth + along);
        return std::ranges::any_of(m_tracer.isosurface().values, [&](double value) {
            return std::min({before, here, after}) <= value + room && std::max({before, here, after}) >= value - room;
        });
    });
}

bool IsosurfaceJudge::accepts(const Line& line, double depth) {
    std::vector<FittedInterval> intervals = m_tracer.intervals(line);
    std::stable_sort(intervals.begin(), intervals.end(),
                     [](const FittedInterval& a, const FittedInterval& b) { return a.from < b.from; });
    double certain = infinity;
    for (const double value : m_tracer.isosurface().values)
        certain = std::min(certain, certain_crossing(intervals, value));
    if (std::isnan(depth))
        return certain == infinity;
    return certain >= depth - length(depth) && is_on_surface(intervals, depth);
}

IsosurfaceComparison compare(IsosurfaceTracer& tracer, const IsosurfacePicture& exact, const Camera& camera, const Frame& frame,
                             const IsosurfaceTolerance& tolerance) {
    if (exact.answers.size() != frame.depth.size())
        throw std::invalid_argument("pictures of different size");
    IsosurfaceJudge judge(tracer, tolerance);
    IsosurfaceComparison result;
    result.n_pixels = exact.answers.size();
    bool has_wrong = false;
    for (std::size_t pixel = 0; pixel < result.n_pixels; ++pixel) {
        const std::optional<Crossing>& crossing = exact.answers[pixel].crossing;
        const bool is_hit = frame.element[pixel] >= 0;
        const bool is_flagged = (frame.flags[pixel] & uncertain) != 0;
        const double depth = is_hit ? frame.depth[pixel] : std::numeric_limits<double>::quiet_NaN();
        result.n_hits += crossing.has_value();
        result.n_flagged += is_flagged;
        result.n_wrong_masks += ((frame.flags[pixel] & pixel_flag::isosurface) != 0) != is_hit;
        if (!crossing && !is_hit) {
            ++result.n_agree;
            result.n_needless_flags += is_flagged;
            continue;
        }
        const double scale = tracer.model().diagonal + (crossing ? crossing->t : 0);
        const double off = crossing && is_hit ? std::abs(depth - crossing->t) : infinity;
        if (off <= tolerance.depth * scale) {
            ++result.n_agree;
            result.n_needless_flags += is_flagged;
            const bool is_well_inside =
                excess(tracer.model().volume.shape(crossing->element), crossing->xi) < -100 * tolerance.depth;
            result.n_other_element += is_well_inside && frame.element[pixel] != tracer.model().volume.number(crossing->element);
        } else {
            const auto column = static_cast<std::uint32_t>(pixel % frame.width),
                       row = static_cast<std::uint32_t>(pixel / frame.width);
            const Line line = line_of(pixel_ray(camera, frame.width, frame.height, column, row));
            if (!judge.accepts(line, depth)) {
                const bool grazes =
                    (crossing ? crossing->facing : std::abs(normal_of(frame, pixel).dot(line.direction))) < grazing;
                ++(is_flagged ? result.n_wrong_flagged : grazes ? result.n_wrong_grazing : result.n_wrong);
                if (!is_flagged) {
                    result.worst_pixel = pixel;
                    has_wrong = true;
                }
                continue;
            }
            ++result.n_rounding;
            if (off > same_sheet * scale)
                continue;
        }
        result.residual = std::max(result.residual, off * crossing->facing * crossing->slope / tracer.range());
        if (crossing->facing < grazing) {
            result.grazing_distance = std::max(result.grazing_distance, off * crossing->facing / crossing->t);
            continue;
        }
        if (off / scale > result.depth_error) {
            result.depth_error = off / scale;
            if (!has_wrong)
                result.worst_pixel = pixel;
        }
        const double normal_error = (normal_of(frame, pixel) - crossing->normal).norm();
        result.normal_error = std::max(result.normal_error, std::isnan(normal_error) ? 2 : normal_error);
    }
    return result;
}

IsosurfaceComparison& IsosurfaceComparison::operator+=(const IsosurfaceComparison& other) {
    for (const auto member :
         {&IsosurfaceComparison::n_pixels, &IsosurfaceComparison::n_hits, &IsosurfaceComparison::n_agree,
          &IsosurfaceComparison::n_rounding, &IsosurfaceComparison::n_wrong_flagged, &IsosurfaceComparison::n_wrong_grazing,
          &IsosurfaceComparison::n_wrong, &IsosurfaceComparison::n_flagged, &IsosurfaceComparison::n_needless_flags,
          &IsosurfaceComparison::n_wrong_masks, &IsosurfaceComparison::n_other_element})
        this->*member += other.*member;
    for (const auto member : {&IsosurfaceComparison::depth_error, &IsosurfaceComparison::normal_error,
                              &IsosurfaceComparison::grazing_distance, &IsosurfaceComparison::residual})
        this->*member = std::max(this->*member, other.*member);
    return *this;
}

std::string to_text(const IsosurfaceComparison& c) {
    char text[1200];
    std::snprintf(text, sizeof text,
                  "pixels                                   %zu\n"
                  "  with a crossing                        %zu\n"
                  "  that agree                             %zu\n"
                  "  that differ within rounding            %zu\n"
                  "  that differ and are flagged            %zu\n"
                  "  that differ, graze, are not flagged    %zu\n"
                  "  that differ and are not flagged        %zu\n"
                  "  flagged                                %zu\n"
                  "  flagged and agreeing                   %zu\n"
                  "  with a wrong isosurface bit            %zu\n"
                  "  with another element                   %zu\n"
                  "error of depth where |n.d| >= 0.05       %.3g of diagonal and depth\n"
                  "error of the normal where |n.d| >= 0.05  %.3g\n"
                  "distance from the surface elsewhere      %.3g of the depth\n"
                  "field off the isovalue                   %.3g of the range\n",
                  c.n_pixels, c.n_hits, c.n_agree, c.n_rounding, c.n_wrong_flagged, c.n_wrong_grazing, c.n_wrong, c.n_flagged,
                  c.n_needless_flags, c.n_wrong_masks, c.n_other_element, c.depth_error, c.normal_error, c.grazing_distance,
                  c.residual);
    return text;
}

} // namespace elvis::oracle
