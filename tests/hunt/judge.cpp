#include "judge.hpp"

#include "line_judge.hpp"
#include "parallel.hpp"
#include "twins.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <tuple>

namespace elvis::hunt {

using oracle::Line;
using oracle::Perturbation;
using oracle::PixelAnswer;
using oracle::SceneOracle;
using oracle::Vector;

namespace {

constexpr std::size_t most_findings = 4;
/** So many flagged pixels of a frame are asked whether rounding decides, and of silent ones about as many for their cause: that
 * takes dozens of answers each. The others count as these. */
constexpr std::uint64_t most_asked = 300;
/** Depths farther apart than this, over diagonal plus depth, belong to different sheets of a surface, however it is seen. */
constexpr double same_sheet = 1e-2;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Line line_of(const FrameRequest& request, std::size_t pixel) {
    return oracle::line_of(oracle::pixel_ray(request.camera, request.width, request.height,
                                             static_cast<long double>(pixel % request.width),
                                             static_cast<long double>(pixel / request.width)));
}

bool has_lines(const FrameRequest& request) { return request.surfaces.size() == 1 && request.surfaces.front().has_lines(); }

Shown shown_of(const FrameRequest& request, const Frame& frame, std::size_t pixel) {
    Shown shown;
    std::copy_n(frame.color.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 4, shown.color.begin());
    shown.is_hit = !std::isnan(frame.depth[pixel]);
    shown.value = frame.value[pixel];
    shown.depth = frame.depth[pixel];
    shown.normal = {frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]};
    shown.element = frame.element[pixel];
    shown.flags = frame.flags[pixel];
    if (shown.is_hit && has_lines(request))
        shown.line = line_color_of(request.surfaces.front(), frame, pixel);
    return shown;
}

std::string text_of(const Shown& s) {
    char text[400];
    std::snprintf(text, sizeof text, "color %.10g %.10g %.10g %.10g", s.color[0], s.color[1], s.color[2], s.color[3]);
    std::string all = text;
    if (s.is_hit) {
        std::snprintf(text, sizeof text, " depth %.15g value %.15g element %lld normal %.10g %.10g %.10g", s.depth, s.value,
                      static_cast<long long>(s.element), s.normal.x(), s.normal.y(), s.normal.z());
        all += text;
    } else {
        all += " no surface";
    }
    return all + " flags " + std::to_string(s.flags);
}

/** A NaN on one side only is an error of the whole channel. */
double color_error(const Color& a, const Color& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const double error = std::abs(a[c] - b[c]);
        largest = std::max(largest, std::isnan(error) ? 1.0 : error);
    }
    return largest;
}

} // namespace

Tally& Tally::operator+=(const Tally& other) {
    pixels += other.pixels;
    hits += other.hits;
    flagged += other.flagged;
    flagged_wrong += other.flagged_wrong;
    near += other.near;
    far += other.far;
    undecidable += other.undecidable;
    all_false_alarms += other.all_false_alarms;
    for (const auto& [bit, n] : other.false_alarms)
        false_alarms[bit] += n;
    for (const auto& [bit, n] : other.silent)
        silent[bit] += n;
    render_seconds += other.render_seconds;
    oracle_seconds += other.oracle_seconds;
    lines += other.lines;
    return *this;
}

Judgement& Judgement::operator+=(Judgement&& other) {
    tally += other.tally;
    findings.insert(findings.end(), other.findings.begin(), other.findings.end());
    return *this;
}

/** For one thread and one precision. */
class PixelJudge {
public:
    PixelJudge(const Judge& judge, SceneOracle& oracle, Precision precision)
        : m_judge(judge), m_oracle(oracle), m_inverter(oracle.model().volume, oracle.model().enclosures),
          m_tolerances(tolerances_of(precision)) {
        const FrameRequest& request = judge.m_request;
        if (request.volume) {
            m_tolerances.color = std::max(m_tolerances.color, request.volume->tolerance);
            m_integral_slack = request.volume->tolerance - m_tolerances.color;
        }
        const oracle::Model& model = oracle.model();
        m_coordinates = std::max(model.tree.lower().cwiseAbs().maxCoeff(), model.tree.upper().cwiseAbs().maxCoeff());
        for (const double eye : request.camera.eye)
            m_coordinates = std::max(m_coordinates, std::abs(eye));
    }

    /** What of `shown` is off the answer by more than the tolerances, colours by more than that and `color_slack`. */
    unsigned compare(const PixelAnswer& answer, const Shown& shown, const Line& line, double color_slack = 0);
    /** Without `asks`, far may be near, and flagged_right a false alarm. */
    Verdict verdict(std::size_t pixel, const Shown& shown, bool asks, unsigned& wrong);
    Shown shown_of(const PixelAnswer& answer) const;

private:
    unsigned compare_point(const PixelAnswer& answer, const Shown& shown, const Line& line);
    bool is_near(std::size_t pixel, const Shown& shown, double position, double field);
    bool rounding_decides(std::size_t pixel, const PixelAnswer& answer, double color_slack);
    double color_rounding(const PixelAnswer& answer, const Line& line);
    template <class Visitor> bool any_perturbed(std::size_t pixel, double position, double field, const Visitor& visitor);
    double length(double depth) const { return m_oracle.model().diagonal + std::abs(depth); }
    /** Of coordinates in double precision, which the oracle's positions have. */
    double coordinate_rounding() const { return 16 * 1.1e-16 * m_coordinates; }

    const Judge& m_judge;
    SceneOracle& m_oracle;
    oracle::Inverter m_inverter;
    Tolerances m_tolerances;
    double m_coordinates = 0;
    /** Of colours, so that those of an integral that says that it missed its tolerance are judged by this. */
    double m_integral_slack = 0;
};

Shown PixelJudge::shown_of(const PixelAnswer& answer) const {
    Shown shown;
    shown.color = answer.color;
    shown.is_hit = answer.surface >= 0;
    if (!shown.is_hit)
        return shown;
    shown.value = answer.value;
    shown.depth = answer.point.t;
    shown.normal = answer.point.normal;
    if (answer.point.element != oracle::SurfacePoint::no_element)
        shown.element = m_oracle.model().volume.number(answer.point.element);
    const Surface& surface = m_judge.m_request.surfaces[static_cast<std::size_t>(answer.surface)];
    shown.flags = std::holds_alternative<Isosurfaces>(surface.geometry) ? pixel_flag::isosurface : 0;
    return shown;
}

unsigned PixelJudge::compare_point(const PixelAnswer& answer, const Shown& shown, const Line& line) {
    const oracle::SurfacePoint& point = answer.point;
    const Vector x = line.at(shown.depth);
    const double along = std::abs(shown.depth - point.t), scale = length(point.t),
                 position = m_tolerances.position * scale + coordinate_rounding();
    unsigned wrong = 0;
    if (!(along * point.facing <= position) || along > same_sheet * scale)
        wrong |= buffer::depth;
    const Shown right = shown_of(answer);
    if ((shown.flags & pixel_flag::isosurface) != right.flags)
        wrong |= buffer::flags;
    if (point.element == oracle::SurfacePoint::no_element)
        return wrong | (shown.element != -1 ? buffer::element : 0);

    Vector gradient;
    m_oracle.value(answer.surface, point.element, point.xi, &gradient);
    const double range = m_oracle.range(answer.surface), slope = gradient.norm();
    const double field = m_tolerances.field * (range + std::abs(answer.value) * 1e-3) + slope * position +
                         2 * std::abs(gradient.dot(line.direction)) * along;
    // Of elements that share the point, the buffer may have either value, if colours tell no difference.
    double off = std::abs(shown.value - answer.value);
    if (shown.element != right.element) {
        const auto other = m_judge.m_elements.find(shown.element);
        std::vector<oracle::Solution> found;
        // A world length in reference coordinates, with room for bent elements.
        if (other != m_judge.m_elements.end())
            found = m_inverter.find(
                other->second, x,
                std::min(1e-2, 4 * position * m_oracle.model().enclosures[other->second].to_reference.norm() + 1e-10));
        if (found.empty())
            wrong |= buffer::element;
        for (const oracle::Solution& there : found)
            off = std::min(off, std::abs(shown.value - m_oracle.value(answer.surface, other->second, there.xi, nullptr)));
    }
    if (!(off <= field))
        wrong |= buffer::value;
    // Of an isosurface, rounding of the field turns the normal the more the less steep it is.
    const double size = 2 / m_oracle.model().enclosures[point.element].to_reference.norm();
    const double steep = right.flags != 0 ? std::max(1.0, range / (size * slope)) : 1;
    const double bend = 20 * (along + position) / size;
    if (!((shown.normal - point.normal).norm() <= m_tolerances.normal * steep + bend))
        wrong |= buffer::normal;
    return wrong;
}

unsigned PixelJudge::compare(const PixelAnswer& answer, const Shown& shown, const Line& line, double color_slack) {
    const Color& color = shown.line.color.value_or(answer.color);
    const bool is_known = shown.line.color || !shown.line.is_line;
    unsigned wrong = !is_known || color_error(color, shown.color) <= m_tolerances.color + color_slack ? 0 : buffer::color;
    const bool is_hit = answer.surface >= 0;
    if (is_hit != shown.is_hit)
        return wrong | buffer::surface;
    return is_hit ? wrong | compare_point(answer, shown, line) : wrong;
}

/** What rounding of the oracle's coordinates makes of its colours: much where the ray runs along the surface. */
double PixelJudge::color_rounding(const PixelAnswer& answer, const Line& line) {
    if (answer.surface < 0 || answer.point.element == oracle::SurfacePoint::no_element)
        return 0;
    Vector gradient;
    m_oracle.value(answer.surface, answer.point.element, answer.point.xi, &gradient);
    const double along = coordinate_rounding() / std::max(answer.point.facing, 1e-9);
    const double value = gradient.norm() * coordinate_rounding() + std::abs(gradient.dot(line.direction)) * along;
    double steepest = 0;
    const auto& points = m_judge.m_request.surfaces[static_cast<std::size_t>(answer.surface)].colors.points;
    for (std::size_t i = 1; i < points.size(); ++i)
        for (std::size_t channel = 0; channel < 3 && points[i].value > points[i - 1].value; ++channel)
            steepest = std::max(steepest, std::abs(points[i].rgb[channel] - points[i - 1].rgb[channel]) /
                                              (points[i].value - points[i - 1].value));
    return steepest * value;
}

/** Whether the visitor accepts an answer of scenes that differ by this: the ray aside, planes along their normal, the field. */
template <class Visitor>
bool PixelJudge::any_perturbed(std::size_t pixel, double position, double field, const Visitor& visitor) {
    const Line line = line_of(m_judge.m_request, pixel);
    const PixelAnswer& answer = m_judge.m_answers[pixel].pixel;
    const double r = position * length(answer.surface >= 0 ? answer.point.t : 0) + coordinate_rounding();
    const Vector across = line.direction.unitOrthogonal(), up = line.direction.cross(across);
    const auto try_one = [&](double a, double b, double c, double plane, double level) {
        const Line moved{line.origin + r * (a * across + b * up + c * line.direction), line.direction};
        return visitor(m_oracle.look(moved, {plane * r, level * field}), moved);
    };
    for (int corner = 0; corner < 8; ++corner) {
        const double a = corner & 1 ? 1 : -1, b = corner & 2 ? 1 : -1, c = corner & 4 ? 1 : -1;
        if (try_one(a, b, c, a * b * c, a * c))
            return true;
    }
    for (const double sign : {1.0, -1.0})
        if (try_one(0, 0, 0, sign, 0) || try_one(0, 0, 0, 0, sign))
            return true;
    return false;
}

bool PixelJudge::is_near(std::size_t pixel, const Shown& shown, double position, double field) {
    for (const double part : {1.0, 0.3, 0.1})
        if (any_perturbed(pixel, part * position, part * field,
                          [&](const PixelAnswer& answer, const Line& line) { return compare(answer, shown, line) == 0; }))
            return true;
    return false;
}

bool PixelJudge::rounding_decides(std::size_t pixel, const PixelAnswer& answer, double color_slack) {
    const Line line = line_of(m_judge.m_request, pixel);
    return any_perturbed(
        pixel, m_tolerances.position_rounding, m_tolerances.field_rounding,
        [&](const PixelAnswer& other, const Line&) { return compare(answer, shown_of(other), line, color_slack) != 0; });
}

Verdict PixelJudge::verdict(std::size_t pixel, const Shown& shown, bool asks, unsigned& wrong) {
    const Answer& answer = m_judge.m_answers[pixel];
    const Line line = line_of(m_judge.m_request, pixel);
    // The flag is about the tolerance that the scene asks for.
    const double color_slack = (shown.flags & pixel_flag::volume_tolerance) != 0 ? m_integral_slack : 0;
    wrong = compare(answer.pixel, shown, line, color_slack);
    if (wrong == 0 && (shown.flags & covering_bits()) == 0)
        return Verdict::right;
    if (answer.is_failure)
        return Verdict::undecidable;
    if ((shown.flags & covering_bits()) != 0) {
        if (wrong != 0)
            return Verdict::flagged_wrong;
        return !asks || rounding_decides(pixel, answer.pixel, color_slack) ? Verdict::flagged_right : Verdict::false_alarm;
    }
    if (!asks)
        return Verdict::far;
    if (compare(answer.pixel, shown, line, color_rounding(answer.pixel, line)) == 0)
        return Verdict::undecidable;
    // Planes exactly in faces and the like: what a few roundings of double precision turn has to be flagged in both precisions.
    constexpr double few_roundings = 1e-15;
    if (is_near(pixel, shown, few_roundings, few_roundings))
        return Verdict::near;
    // The oracle's own rounding is that of float64.
    const Tolerances own = tolerances_of(Precision::float64);
    if (is_near(pixel, shown, own.position_rounding, own.field_rounding))
        return Verdict::undecidable;
    const bool is_single = m_tolerances.position > 1e-9;
    return is_single && is_near(pixel, shown, m_tolerances.position, m_tolerances.field) ? Verdict::near : Verdict::far;
}

Judge::Judge(oracle::SceneVolume& volume, const FrameRequest& request, std::string& reason) : m_request(request) {
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
        std::shared_ptr<SceneOracle> oracle = SceneOracle::make(volume, request, reason);
        if (!oracle)
            return;
        m_oracles.push_back(std::move(oracle));
    }
    const oracle::Volume& elements = m_oracles.front()->model().volume;
    for (std::size_t element = 0; element < elements.n_elements(); ++element)
        m_elements[elements.number(element)] = element;
}

Judge::Judge(const Judge& larger, const FrameRequest& smaller)
    : m_request(smaller), m_oracles(larger.m_oracles), m_elements(larger.m_elements) {
    for (std::size_t pixel = 0; pixel < std::size_t{smaller.width} * smaller.height; ++pixel)
        m_answers.push_back(larger.m_answers[pixel_with_same_ray(larger.m_request, smaller, pixel)]);
}

void Judge::draw() {
    const auto start = std::chrono::steady_clock::now();
    m_answers.resize(std::size_t{m_request.width} * m_request.height);
    for_rows(m_oracles.size(), m_request.height, [&](std::size_t thread, std::uint32_t row) {
        SceneOracle& oracle = *m_oracles[thread];
        for (std::uint32_t column = 0; column < m_request.width; ++column) {
            const std::size_t pixel = std::size_t{row} * m_request.width + column;
            const std::uint64_t failures = oracle.n_failures();
            m_answers[pixel].pixel = oracle.look(line_of(m_request, pixel));
            m_answers[pixel].is_failure = oracle.n_failures() != failures;
        }
    });
    m_seconds = seconds_since(start);
}

namespace {

void count(const Shown& shown, Verdict verdict, unsigned wrong, std::uint64_t weight, Tally& tally) {
    tally.flagged_wrong += verdict == Verdict::flagged_wrong;
    if (verdict == Verdict::near)
        tally.near += weight;
    if (verdict == Verdict::far)
        tally.far += weight;
    if (verdict == Verdict::undecidable)
        tally.undecidable += weight;
    if (verdict == Verdict::false_alarm) {
        tally.all_false_alarms += weight;
        for (const FlagName& flag : named_flags)
            if ((shown.flags & covering_bits() & flag.bit) != 0)
                tally.false_alarms[flag.bit] += weight;
    }
    if (verdict == Verdict::near || verdict == Verdict::far)
        for (const auto& [bit, name] : buffer::names)
            if ((wrong & bit) != 0)
                tally.silent[bit] += weight;
}

} // namespace

Judgement Judge::judge(const Frame& frame, Precision precision) const {
    const auto start = std::chrono::steady_clock::now();
    std::vector<PixelJudge> judges;
    for (const auto& oracle : m_oracles)
        judges.emplace_back(*this, *oracle, precision);
    std::vector<Judgement> parts(m_oracles.size());
    std::vector<std::vector<std::size_t>> open(m_oracles.size());
    for_rows(m_oracles.size(), m_request.height, [&](std::size_t thread, std::uint32_t row) {
        Tally& tally = parts[thread].tally;
        for (std::uint32_t column = 0; column < m_request.width; ++column) {
            const std::size_t pixel = std::size_t{row} * m_request.width + column;
            const Shown shown = hunt::shown_of(m_request, frame, pixel);
            unsigned wrong = 0;
            const Verdict verdict = judges[thread].verdict(pixel, shown, false, wrong);
            ++tally.pixels;
            tally.hits += m_answers[pixel].pixel.surface >= 0;
            tally.flagged += (shown.flags & covering_bits()) != 0;
            if (verdict == Verdict::far || verdict == Verdict::flagged_right)
                open[thread].push_back(pixel);
            else
                count(shown, verdict, wrong, 1, tally);
        }
    });
    // What is flagged, and what is silent, each in even steps over the picture.
    std::array<std::vector<std::size_t>, 2> asked;
    for (const std::vector<std::size_t>& some : open)
        for (const std::size_t pixel : some)
            asked[(frame.flags[pixel] & covering_bits()) != 0 ? 1 : 0].push_back(pixel);
    for (std::vector<std::size_t>& pixels : asked) {
        std::ranges::sort(pixels);
        for_some(m_oracles.size(), pixels, most_asked, [&](std::size_t thread, std::size_t pixel, std::uint64_t weight) {
            const Shown shown = hunt::shown_of(m_request, frame, pixel);
            unsigned wrong = 0;
            const Verdict verdict = judges[thread].verdict(pixel, shown, true, wrong);
            count(shown, verdict, wrong, weight, parts[thread].tally);
            if (verdict == Verdict::near || verdict == Verdict::far)
                parts[thread].findings.push_back({static_cast<std::uint32_t>(pixel / m_request.width),
                                                  static_cast<std::uint32_t>(pixel % m_request.width), verdict, wrong,
                                                  text_of(shown), text_of(judges[thread].shown_of(m_answers[pixel].pixel))});
        });
    }
    Judgement all;
    for (Judgement& part : parts)
        all += std::move(part);
    if (has_lines(m_request))
        all += judge_lines(m_request, frame, precision, m_answers, m_oracles);
    std::ranges::sort(all.findings, [](const Finding& a, const Finding& b) {
        return std::tuple(a.verdict != Verdict::far, a.row, a.column) < std::tuple(b.verdict != Verdict::far, b.row, b.column);
    });
    if (all.findings.size() > most_findings)
        all.findings.resize(most_findings);
    all.tally.oracle_seconds = seconds_since(start);
    return all;
}

} // namespace elvis::hunt
