#include "volume_integral.hpp"

#include <core/base/infinity.hpp>
#include <core/oracle/samples/random.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>
#include <thread>

namespace elvis::oracle {
namespace {

using Rgb = Eigen::Array3d;

// What is behind this cannot be seen: it is left out.
constexpr double least_transmittance = 1e-20;
// Of each interval's integral over its transmittance; rounding is a few 1e-16.
constexpr double quadrature_tolerance = 1e-14;
constexpr int deepest_halving = 40;

// A channel as value(f) = at + slope (f - from).
struct LinearChannel {
    double at = 0, slope = 0;
};

struct LinearOptics {
    double from = 0;
    LinearChannel density;
    std::array<LinearChannel, 3> rgb;
};

template <class Point, class Channel>
LinearChannel channel_about(const std::vector<Point>& points, double value, double from, Channel channel) {
    // The last point not above the value.
    std::size_t i = points.size();
    while (i > 0 && points[i - 1].value > value)
        --i;
    if (i == 0)
        return {channel(points.front()), 0};
    if (i == points.size())
        return {channel(points.back()), 0};
    const Point& low = points[i - 1];
    const double slope = (channel(points[i]) - channel(low)) / (points[i].value - low.value);
    return {channel(low) + slope * (from - low.value), slope};
}

// Exact for all values between the same breakpoints as `value`; `from` should be one of these for the sake of rounding.
LinearOptics optics_about(const TransferFunction& transfer, double value, double from) {
    LinearOptics optics;
    optics.from = from;
    optics.density = channel_about(transfer.density, value, from, [](const auto& point) { return point.density; });
    for (std::size_t c = 0; c < 3; ++c)
        optics.rgb[c] = channel_about(transfer.color, value, from, [c](const auto& point) { return point.rgb[c]; });
    return optics;
}

struct Quadrature {
    std::vector<double> points, kronrod, gauss;
};

// 31 points, of which every other one is Gauss's, in [-1, 1].
const Quadrature& quadrature() {
    static const Quadrature rule = [] {
        using Kronrod = boost::math::quadrature::gauss_kronrod<double, 31>;
        using Gauss = boost::math::quadrature::gauss<double, 15>;
        Quadrature made;
        for (std::size_t i = 0; i < Kronrod::abscissa().size(); ++i)
            for (const double sign : {1.0, -1.0}) {
                if (i == 0 && sign < 0)
                    continue;
                made.points.push_back(sign * Kronrod::abscissa()[i]);
                made.kronrod.push_back(Kronrod::weights()[i]);
                made.gauss.push_back(i % 2 == 0 ? Gauss::weights()[i / 2] : 0);
            }
        return made;
    }();
    return rule;
}

// The integral over [a, b], halved until both rules agree, or as nearly as values with this relative rounding can.
template <class Function>
Rgb integrate_adaptively(const Function& function, double a, double b, double tolerance, double rounding, int depth,
                         double& error) {
    const Quadrature& rule = quadrature();
    const double half = 0.5 * (b - a), middle = 0.5 * (a + b);
    Rgb kronrod = Rgb::Zero(), gauss = Rgb::Zero(), size = Rgb::Zero();
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
        const Rgb value = function(middle + half * rule.points[i]);
        kronrod += rule.kronrod[i] * value;
        gauss += rule.gauss[i] * value;
        size += rule.kronrod[i] * value.abs();
    }
    kronrod *= half;
    gauss *= half;
    const double off = (kronrod - gauss).abs().maxCoeff();
    if (off <= std::max(tolerance, rounding * half * size.maxCoeff()) || depth == deepest_halving) {
        error += off;
        return kronrod;
    }
    return integrate_adaptively(function, a, middle, 0.5 * tolerance, rounding, depth + 1, error) +
           integrate_adaptively(function, middle, b, 0.5 * tolerance, rounding, depth + 1, error);
}

// The field less `from` on a part of a series' interval, as a series of its own: integrals of short segments keep their digits.
ChebyshevSeries part_of(const ChebyshevSeries& field, double begin, double end, double from) {
    std::vector<double> values;
    for (const double s : lobatto_points(field.degree()))
        values.push_back(field(0.5 * ((1 - s) * begin + (1 + s) * end)) - from);
    return ChebyshevSeries(values);
}

void add_smooth_interval(const ChebyshevSeries& field, const LinearOptics& optics, double length, VolumeFormula formula,
                         VolumeLight& light) {
    const double half = 0.5 * length;
    const ChebyshevSeries integral = field.antiderivative();
    const auto depth = [&](double s) { return half * (optics.density.at * (1 + s) + optics.density.slope * integral(s)); };
    const auto color = [&](double value) {
        Rgb rgb;
        for (std::size_t c = 0; c < 3; ++c)
            rgb[static_cast<Eigen::Index>(c)] = optics.rgb[c].at + optics.rgb[c].slope * value;
        return rgb;
    };
    const Rgb slope(optics.rgb[0].slope, optics.rgb[1].slope, optics.rgb[2].slope);
    const double thinning = std::exp(-depth(1));
    // That of the inner integral, for which the field's is at most its series' size.
    const double rounding = 1e-15 * (4 + half * (2 * optics.density.at + std::abs(optics.density.slope) * integral.size()));
    double error = 0;
    Rgb added;
    if (formula == VolumeFormula::emission) {
        const auto emission = [&](double s) -> Rgb {
            const double value = field(s);
            return color(value) * (half * (optics.density.at + optics.density.slope * value) * std::exp(-depth(s)));
        };
        added = integrate_adaptively(emission, -1, 1, quadrature_tolerance, rounding, 0, error);
    } else {
        const ChebyshevSeries change = field.derivative();
        const auto rest = [&](double s) -> Rgb { return slope * (change(s) * std::exp(-depth(s))); };
        added = color(field(-1)) - color(field(1)) * thinning;
        if ((slope != 0).any())
            added += integrate_adaptively(rest, -1, 1, quadrature_tolerance, rounding, 0, error);
    }
    error += (std::abs(optics.density.slope) * length + slope.abs().maxCoeff() * (1 - thinning)) * field.tail();
    for (std::size_t c = 0; c < 3; ++c)
        light.rgb[c] += light.transmittance * added[static_cast<Eigen::Index>(c)];
    light.error += light.transmittance * error;
    light.transmittance *= thinning;
    ++light.n_smooth_intervals;
}

} // namespace

OpticalPoint optical_point(const TransferFunction& transfer, double value) {
    const LinearOptics optics = optics_about(transfer, value, value);
    return {optics.density.at, {optics.rgb[0].at, optics.rgb[1].at, optics.rgb[2].at}};
}

Color color_over(const VolumeLight& light, const Color& background) {
    const double behind = light.transmittance * background[3], alpha = 1 - light.transmittance + behind;
    Color color = background;
    color[3] = alpha;
    if (alpha > 0)
        for (std::size_t c = 0; c < 3; ++c)
            color[c] = (light.rgb[c] + behind * background[c]) / alpha;
    return color;
}

VolumeTracer::VolumeTracer(const Model& model, const VolumeOptics& optics)
    : m_transfer(optics.transfer), m_tracer(model, {optics.scalar, {}}) {
    std::set<double> values;
    for (const auto& point : m_transfer.density)
        values.insert(point.value);
    for (const auto& point : m_transfer.color)
        values.insert(point.value);
    m_breakpoints.assign(values.begin(), values.end());
}

std::vector<OwnedInterval> VolumeTracer::owned_intervals(const Line& line, double until) {
    std::vector<FittedInterval> intervals = m_tracer.intervals(line, until);
    const Model& model = m_tracer.model();
    std::sort(intervals.begin(), intervals.end(), [&](const FittedInterval& a, const FittedInterval& b) {
        return a.element != b.element ? model.volume.number(a.element) < model.volume.number(b.element) : a.from < b.from;
    });
    // Intervals of an element that touch are one stay in it.
    const double touch = 1e-12 * (model.diagonal + line.origin.norm());
    struct Stay {
        double entry = 0;
        std::vector<FittedInterval> intervals;
    };
    std::vector<Stay> stays;
    for (FittedInterval& interval : intervals) {
        const bool goes_on = !stays.empty() && stays.back().intervals.back().element == interval.element &&
                             interval.from <= stays.back().intervals.back().to + touch;
        if (!goes_on)
            stays.push_back({interval.from, {}});
        stays.back().intervals.push_back(std::move(interval));
    }
    std::stable_sort(stays.begin(), stays.end(), [](const Stay& a, const Stay& b) { return a.entry < b.entry; });
    std::vector<OwnedInterval> owned;
    double reached = 0;
    for (Stay& stay : stays)
        for (FittedInterval& interval : stay.intervals) {
            const double from = std::max(interval.from, reached), to = std::min(interval.to, until);
            if (!(from < to))
                continue;
            const auto s_of = [&](double t) {
                return std::clamp((2 * t - interval.from - interval.to) / (interval.to - interval.from), -1.0, 1.0);
            };
            const double begin = from == interval.from ? -1 : s_of(from), end = to == interval.to ? 1 : s_of(to);
            reached = to;
            owned.push_back({std::move(interval), begin, end});
        }
    return owned;
}

void VolumeTracer::add(const OwnedInterval& owned, VolumeFormula formula, VolumeLight& light) const {
    const FittedInterval& interval = owned.interval;
    std::vector<double> cuts{owned.begin, owned.end};
    const std::vector<double> values = interval.field.dense_values();
    for (const double breakpoint : m_breakpoints) {
        std::vector<double> differences = values;
        for (double& difference : differences)
            difference -= breakpoint;
        const Roots roots = find_roots([&](double s) { return interval.field(s); }, breakpoint,
                                       lobatto_points(4 * interval.field.degree()), differences);
        for (const double s : roots.at)
            if (s > owned.begin && s < owned.end)
                cuts.push_back(s);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size() && light.transmittance > least_transmittance; ++i) {
        if (!(cuts[i - 1] < cuts[i]))
            continue;
        const double value = interval.field(0.5 * (cuts[i - 1] + cuts[i]));
        const auto above = std::upper_bound(m_breakpoints.begin(), m_breakpoints.end(), value);
        const double from = above == m_breakpoints.begin() ? *above : *std::prev(above);
        const double length = 0.5 * (cuts[i] - cuts[i - 1]) * (interval.to - interval.from);
        add_smooth_interval(part_of(interval.field, cuts[i - 1], cuts[i], from), optics_about(m_transfer, value, from), length,
                            formula, light);
    }
}

VolumeLight VolumeTracer::integrate(const Line& line, double until, VolumeFormula formula) {
    VolumeLight light;
    for (const OwnedInterval& owned : owned_intervals(line, until))
        add(owned, formula, light);
    return light;
}

std::vector<VolumeLight> VolumeTracer::integrate_between(const Line& line, std::span<const double> stops) {
    std::vector<VolumeLight> lights(stops.size() - 1);
    for (const OwnedInterval& owned : owned_intervals(line, stops.back())) {
        const double from = owned.interval.from, to = owned.interval.to;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            OwnedInterval part = owned;
            const auto s_of = [&](double t) { return t == infinity ? 1 : (2 * t - from - to) / (to - from); };
            part.begin = std::max(owned.begin, s_of(stops[i]));
            part.end = std::min(owned.end, s_of(stops[i + 1]));
            if (part.begin < part.end)
                add(part, VolumeFormula::emission, lights[i]);
        }
    }
    return lights;
}

VolumePicture draw_volume(const Model& model, const VolumeOptics& optics, const Camera& camera, std::uint32_t width,
                          std::uint32_t height, std::vector<std::size_t> pixels, std::span<const double> depths) {
    const auto start = std::chrono::steady_clock::now();
    VolumePicture picture;
    picture.pixels = std::move(pixels);
    if (picture.pixels.empty()) {
        picture.pixels.resize(std::size_t{width} * height);
        std::iota(picture.pixels.begin(), picture.pixels.end(), std::size_t{0});
    }
    picture.answers.resize(picture.pixels.size());
    std::vector<VolumeTracer> tracers(std::max(1u, std::thread::hardware_concurrency()), VolumeTracer(model, optics));
    std::atomic<std::size_t> next = 0;
    {
        std::vector<std::jthread> threads;
        for (VolumeTracer& tracer : tracers)
            threads.emplace_back([&] {
                for (std::size_t i = next++; i < picture.pixels.size(); i = next++) {
                    const std::size_t pixel = picture.pixels[i];
                    const Line line = line_of(pixel_ray(camera, width, height, static_cast<long double>(pixel % width),
                                                        static_cast<long double>(pixel / width)));
                    const bool is_hidden = !depths.empty() && !std::isnan(depths[pixel]);
                    picture.answers[i] =
                        tracer.integrate(line, is_hidden ? depths[pixel] : std::numeric_limits<double>::infinity());
                }
            });
    }
    for (const VolumeTracer& tracer : tracers)
        picture.n_failures += tracer.n_failures();
    picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

std::vector<std::size_t> sampled_pixels(std::size_t n_pixels, std::size_t count, std::uint64_t seed) {
    std::vector<std::size_t> all(n_pixels);
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (count >= n_pixels)
        return all;
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i)
        std::swap(all[i], all[static_cast<std::size_t>(random.between(static_cast<double>(i), static_cast<double>(n_pixels)))]);
    all.resize(count);
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace elvis::oracle
