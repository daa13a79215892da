#include "line_judge.hpp"

#include "lines.hpp"
#include "parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace elvis::hunt {
namespace {

using oracle::SurfacePoint;
using oracle::Vector;

struct LineFlags {
    LineKind kind;
    std::uint32_t met, open;
    unsigned buffer;
};
constexpr std::array<LineFlags, 2> line_flags{
    {{LineKind::contour, pixel_flag::contour, pixel_flag::contour_undecided, buffer::contour},
     {LineKind::mesh_line, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided, buffer::mesh_line}}};

/** Why a pixel is judged, and of how many in a picture at most; each costs hundreds of rays. */
enum Group { none_beside_line, met_beside_none, met, open, none, n_groups };
constexpr std::array<std::size_t, n_groups> most_judged{200, 200, 60, 60, 60};
/** Rays that meet isosurfaces cost some hundred times as much as others. */
constexpr std::size_t fewer_on_isosurfaces = 10;

/** The square is closed: what lies beside it by less than this part of a pixel may be in it. */
constexpr double closed = 0.01;
/** A line, or none, in a square that is so much smaller or larger, is no open question. */
constexpr double clear = 0.1;
/** Where rounding is so much of a pixel, nothing can be told. */
constexpr double coarse = 0.25;

oracle::Ray ray_of(const FrameRequest& request, std::size_t pixel) {
    return oracle::pixel_ray(request.camera, request.width, request.height, static_cast<long double>(pixel % request.width),
                             static_cast<long double>(pixel / request.width));
}

class PixelLines {
public:
    PixelLines(const FrameRequest& request, oracle::SceneOracle& oracle, Precision precision)
        : m_request(request), m_oracle(oracle), m_lines(oracle, request), m_tolerances(tolerances_of(precision)),
          m_is_double(precision == Precision::float64) {
        const oracle::Model& model = oracle.model();
        m_coordinates = std::max(model.tree.lower().cwiseAbs().maxCoeff(), model.tree.upper().cwiseAbs().maxCoeff());
        for (const double eye : request.camera.eye)
            m_coordinates = std::max(m_coordinates, std::abs(eye));
    }

    Verdict verdict(std::size_t pixel, const oracle::PixelAnswer& answer, const LineFlags& line, std::uint32_t flags) {
        SurfacePoint point = answer.point;
        // Beside the volume a plane goes on.
        if (answer.surface < 0)
            point.t = plane_depth(pixel);
        if (std::isnan(point.t))
            return (flags & (line.met | line.open)) == 0 ? Verdict::right : Verdict::undecidable;
        set_rounding(point);
        if (m_aside > coarse)
            return Verdict::undecidable;
        m_square = {static_cast<double>(pixel % m_request.width), static_cast<double>(pixel / m_request.width)};
        m_kind = line.kind;
        if ((flags & line.open) != 0)
            return is_clear() ? Verdict::false_alarm : Verdict::flagged_right;
        return (flags & line.met) != 0 ? of_met() : of_none();
    }

private:
    double plane_depth(std::size_t pixel) const {
        const auto* plane = std::get_if<CutPlane>(&m_request.surfaces.front().geometry);
        const auto depth = oracle::plane_distance(ray_of(m_request, pixel), *plane);
        return depth ? static_cast<double>(*depth) : std::numeric_limits<double>::quiet_NaN();
    }
    /** How far rounding moves lines, in pixels, and values. */
    void set_rounding(const SurfacePoint& point) {
        const double length = m_oracle.model().diagonal + std::abs(point.t);
        const double world = m_tolerances.position_rounding * length + 2e-15 * m_coordinates;
        m_aside = 4 * world / m_lines.pixel_length(point.t);
        m_level = m_tolerances.field_rounding * m_oracle.range(0);
        if (point.element != SurfacePoint::no_element && point.facing > 0) {
            Vector gradient;
            m_oracle.value(0, point.element, point.xi, &gradient);
            m_level += gradient.norm() * world / point.facing;
        }
    }
    bool is_proven(double half, double beyond) {
        return m_lines.is_proven({m_square.column, m_square.row, half}, {m_kind, beyond, 9});
    }
    bool is_found(double half, double beyond, int n) {
        return m_lines.is_found({m_square.column, m_square.row, half}, {m_kind, beyond, n});
    }
    bool is_clear() {
        if (m_request.surfaces.front().subdivisions < Surface{}.subdivisions)
            return false;
        return is_proven(0.5 - clear, m_level) || !is_found(0.5 + clear + m_aside, -m_level, 9);
    }
    Verdict of_none() {
        if (!is_proven(0.5 - 1e-6, 0))
            return Verdict::right;
        return is_proven(0.5 - closed - m_aside, m_level) ? Verdict::far : near();
    }
    Verdict of_met() {
        const double half = 0.5 + closed;
        if (is_proven(half, 0) || is_found(half, 0, 9))
            return Verdict::right;
        if (m_n_dense++ > most_dense)
            return Verdict::undecidable;
        if (is_found(half, 0, 60))
            return Verdict::right;
        return is_found(half + m_aside, -m_level, 60) ? near() : Verdict::far;
    }
    /** The oracle's own rounding is that of float64. */
    Verdict near() const { return m_is_double ? Verdict::undecidable : Verdict::near; }

    static constexpr std::uint64_t most_dense = 6;

    const FrameRequest& m_request;
    oracle::SceneOracle& m_oracle;
    LineOracle m_lines;
    Tolerances m_tolerances;
    bool m_is_double;
    double m_coordinates = 0, m_aside = 0, m_level = 0;
    PictureSquare m_square;
    LineKind m_kind = LineKind::contour;
    std::uint64_t m_n_dense = 0;
};

/** Which pixels are judged for one kind of lines. */
class Choice {
public:
    Choice(const FrameRequest& request, const Frame& frame, const std::vector<Answer>& answers)
        : m_request(request), m_surface(request.surfaces.front()), m_frame(frame), m_answers(answers),
          m_is_plane(std::holds_alternative<CutPlane>(m_surface.geometry)) {}

    std::array<std::vector<std::size_t>, n_groups> of(const LineFlags& line) const {
        std::array<std::vector<std::size_t>, n_groups> groups;
        for (std::size_t pixel = 0; pixel < m_answers.size(); ++pixel)
            if (can_be_judged(pixel))
                groups[group(pixel, line)].push_back(pixel);
        return groups;
    }

private:
    bool can_be_judged(std::size_t pixel) const {
        const oracle::PixelAnswer& answer = m_answers[pixel].pixel;
        const bool is_hit = answer.surface >= 0;
        // Beside surfaces that are not planes nothing is drawn.
        return (m_frame.flags[pixel] & covering_bits()) == 0 && !m_answers[pixel].is_failure &&
               is_hit == !std::isnan(m_frame.depth[pixel]) && (is_hit || m_is_plane) && !is_near_clip(pixel);
    }
    /** Lines that are cut away within a pixel may be marked or not. */
    bool is_near_clip(std::size_t pixel) const {
        if (m_surface.clip.empty())
            return false;
        // A neighbour may see what is cut away here, far in front.
        bool is_near = m_answers[pixel].pixel.surface < 0 || distance_to_clip(pixel) < 1;
        for_neighbours(pixel, [&](std::size_t other) {
            is_near = is_near || m_answers[other].pixel.surface < 0 || distance_to_clip(other) < 1;
        });
        return is_near;
    }
    /** In steps from this pixel to its neighbours on the surface. */
    double distance_to_clip(std::size_t pixel) const {
        const Vector x = position(pixel);
        double step = 0, least = 1e300;
        for_neighbours(pixel, [&](std::size_t other) {
            if (m_answers[other].pixel.surface >= 0)
                step = std::max(step, (position(other) - x).norm());
        });
        for (const std::array<double, 4>& plane : m_surface.clip) {
            const Vector normal(plane[0], plane[1], plane[2]);
            least = std::min(least, std::abs(normal.dot(x) + plane[3]) / normal.norm());
        }
        return step > 0 ? least / step : 0;
    }
    Vector position(std::size_t pixel) const {
        return oracle::line_of(ray_of(m_request, pixel)).at(m_answers[pixel].pixel.point.t);
    }
    template <class Visitor> void for_neighbours(std::size_t pixel, const Visitor& visitor) const {
        const auto width = static_cast<int>(m_request.width), height = static_cast<int>(m_request.height);
        const int column = static_cast<int>(pixel) % width, row = static_cast<int>(pixel) / width;
        for (int r = std::max(0, row - 1); r <= std::min(height - 1, row + 1); ++r)
            for (int c = std::max(0, column - 1); c <= std::min(width - 1, column + 1); ++c)
                if (r != row || c != column)
                    visitor(static_cast<std::size_t>(r * width + c));
    }
    Group group(std::size_t pixel, const LineFlags& line) const {
        const std::uint32_t flags = m_frame.flags[pixel];
        if ((flags & line.open) != 0)
            return open;
        bool is_beside = false;
        for_neighbours(pixel, [&](std::size_t other) { is_beside = is_beside || differ(pixel, other, line.kind); });
        if ((flags & line.met) != 0)
            return is_beside ? met : met_beside_none;
        return is_beside ? none_beside_line : none;
    }
    bool differ(std::size_t pixel, std::size_t other, LineKind kind) const {
        const oracle::PixelAnswer &a = m_answers[pixel].pixel, &b = m_answers[other].pixel;
        if (a.surface < 0 || b.surface < 0)
            return kind == LineKind::mesh_line && a.surface != b.surface;
        if (kind == LineKind::mesh_line)
            return a.point.element != b.point.element;
        return std::ranges::any_of(m_surface.contours->values,
                                   [&](double value) { return (a.value < value) != (b.value < value); });
    }

    const FrameRequest& m_request;
    const Surface& m_surface;
    const Frame& m_frame;
    const std::vector<Answer>& m_answers;
    bool m_is_plane;
};

std::string text_of(std::uint32_t flags, const LineFlags& line) {
    const std::string name = line.kind == LineKind::contour ? "contour" : "mesh line";
    return ((flags & line.met) != 0 ? "meets a " : "meets no ") + name + " flags " + std::to_string(flags);
}

void record(std::size_t pixel, std::uint32_t width, std::uint32_t flags, Verdict verdict, const LineFlags& line,
            std::uint64_t weight, Judgement& judgement) {
    Tally& tally = judgement.tally;
    if (verdict == Verdict::false_alarm) {
        tally.false_alarms[line.open] += weight;
        tally.all_false_alarms += weight;
    }
    tally.undecidable += verdict == Verdict::undecidable ? weight : 0;
    if (verdict != Verdict::near && verdict != Verdict::far)
        return;
    (verdict == Verdict::near ? tally.near : tally.far) += weight;
    tally.silent[line.buffer] += weight;
    judgement.findings.push_back({static_cast<std::uint32_t>(pixel / width), static_cast<std::uint32_t>(pixel % width), verdict,
                                  line.buffer, text_of(flags, line), text_of(flags ^ line.met, line)});
}

struct NearFlags {
    std::uint32_t flags = 0;
    /** A line may pass nearer to the pixel's middle than half of its width, or not: which part of a pixel it meets is not told.
     */
    bool is_uncertain = false;
    /** The surface is not seen in one of the pixels: cut away there, it may have a line that reaches as far as this one. */
    bool has_hidden = false;
};

/** Depths of neighbours that differ by this share may be of different layers. */
constexpr double another_layer = 0.03;

/** Those in `of`. */
NearFlags flags_near(const Frame& frame, std::size_t pixel, double line_width, std::uint32_t of) {
    const auto width = static_cast<int>(frame.width), height = static_cast<int>(frame.height);
    const int column = static_cast<int>(pixel) % width, row = static_cast<int>(pixel) / width;
    // From the middle of a pixel to its corners.
    constexpr double corner = 0.7072;
    const double reach = 0.5 * line_width;
    const int most = line_width > 1 ? static_cast<int>(reach + corner) : 0;
    NearFlags near;
    std::uint32_t possible = 0;
    for (int r = std::max(0, row - most); r <= std::min(height - 1, row + most); ++r)
        for (int c = std::max(0, column - most); c <= std::min(width - 1, column + most); ++c) {
            const double distance = std::hypot(r - row, c - column);
            const auto there = static_cast<std::size_t>(r * width + c);
            near.flags |= distance == 0 || distance <= reach - corner ? frame.flags[there] & of : 0;
            possible |= distance <= reach + corner ? frame.flags[there] & of : 0;
            // Or something far in front is cut away in one of the two.
            near.has_hidden = near.has_hidden || std::isnan(frame.depth[there]) ||
                              std::abs(frame.depth[there] - frame.depth[pixel]) > another_layer * frame.depth[pixel];
        }
    near.is_uncertain = possible != near.flags;
    return near;
}

Color opaque(const std::array<double, 3>& rgb) { return {rgb[0], rgb[1], rgb[2], 1}; }

} // namespace

LineColor line_color_of(const Surface& surface, const Frame& frame, std::size_t pixel) {
    LineColor line;
    bool has_cut_away = false, is_told = true;
    if (surface.mesh_lines) {
        const LineStyle& style = surface.mesh_lines->style;
        const auto [flags, is_uncertain, has_hidden] =
            flags_near(frame, pixel, style.width, pixel_flag::mesh_line | pixel_flag::mesh_line_undecided);
        is_told = is_told && !is_uncertain;
        has_cut_away = has_cut_away || has_hidden;
        const bool is_open = (flags & pixel_flag::mesh_line_undecided) != 0, is_met = (flags & pixel_flag::mesh_line) != 0;
        line.is_line = is_met || is_open;
        const auto& color = is_open && !is_met && style.undecided_color ? style.undecided_color : style.color;
        if (line.is_line && color)
            line.color = opaque(*color);
    }
    if (surface.contours) {
        const Contours& contours = *surface.contours;
        const auto [flags, is_uncertain, has_hidden] =
            flags_near(frame, pixel, contours.style.width, pixel_flag::contour | pixel_flag::contour_undecided);
        is_told = is_told && !is_uncertain;
        has_cut_away = has_cut_away || has_hidden;
        const bool is_open = (flags & pixel_flag::contour_undecided) != 0, is_met = (flags & pixel_flag::contour) != 0;
        const bool has_own = contours.style.undecided_color.has_value();
        if (is_met || (is_open && (has_own || contours.inks.empty()))) {
            line.is_line = true;
            const auto nearest = std::ranges::min_element(contours.values, {},
                                                          [&](double value) { return std::abs(value - frame.value[pixel]); });
            line.color.reset();
            if (is_open && !is_met && has_own)
                line.color = opaque(*contours.style.undecided_color);
            else if (!contours.inks.empty() || contours.style.color)
                line.color = opaque(contours.color(static_cast<std::size_t>(nearest - contours.values.begin())));
        }
    }
    if (!is_told || (has_cut_away && !surface.clip.empty()))
        return {.is_line = true};
    return line;
}

Judgement judge_lines(const FrameRequest& request, const Frame& frame, Precision precision, const std::vector<Answer>& answers,
                      const std::vector<std::shared_ptr<oracle::SceneOracle>>& oracles) {
    const Surface& surface = request.surfaces.front();
    const std::size_t fewer = std::holds_alternative<Isosurfaces>(surface.geometry) ? fewer_on_isosurfaces : 1;
    const Choice choice(request, frame, answers);
    std::vector<Judgement> parts(oracles.size());
    std::vector<PixelLines> judges;
    for (const auto& oracle : oracles)
        judges.emplace_back(request, *oracle, precision);
    for (const LineFlags& line : line_flags) {
        if (!(line.kind == LineKind::contour ? surface.contours.has_value() : surface.mesh_lines.has_value()))
            continue;
        const auto groups = choice.of(line);
        for (std::size_t group = 0; group < n_groups; ++group)
            for_some(oracles.size(), groups[group], most_judged[group] / fewer,
                     [&](std::size_t thread, std::size_t pixel, std::uint64_t weight) {
                         const std::uint32_t flags = frame.flags[pixel];
                         const Verdict verdict = judges[thread].verdict(pixel, answers[pixel].pixel, line, flags);
                         record(pixel, request.width, flags, verdict, line, weight, parts[thread]);
                         ++parts[thread].tally.lines;
                     });
    }
    Judgement all;
    for (Judgement& part : parts)
        all += std::move(part);
    return all;
}

} // namespace elvis::hunt
