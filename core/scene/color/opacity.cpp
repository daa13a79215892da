#include <core/scene/color/opacity.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

using DensityPoint = TransferFunction::DensityPoint;

constexpr double most_opacity = 1 - 1e-6;
/** As a part of the largest density. */
constexpr double chord_tolerance = 1e-4;
/** VTK takes what is nearer to 0 or 1 than this as linear, or as a step. */
constexpr double least_sharpness = 0.01;
/** VTK keeps midpoints so far from the ends. */
constexpr double least_midpoint = 1e-5;

/**
 * How far the chord over an increase of `rise` is above tau = -ln(1 - opacity). With u = 1 - opacity, as a part of its first
 * value, the chord is rise (1 - u) / (1 - exp(-rise)); it is farthest where u = (1 - exp(-rise)) / rise, by 1/u - 1 + ln u.
 * That the distance depends on the rise only makes equal steps of tau the best.
 */
double chord_error(double rise) {
    const double u = -std::expm1(-rise) / rise;
    // The difference of terms near 1 says nothing for small rises.
    return rise < 1e-2 ? rise * rise / 8 : 1 / u - 1 + std::log(u);
}

/** Appends points behind `from` up to `to`, between which opacity is linear; tau is for a unit distance of 1. */
void append_linear(const OpacityPoint& from, const OpacityPoint& to, double unit_distance, double tolerance,
                   std::vector<DensityPoint>& out) {
    // Beyond the largest opacity tau is constant.
    const double first = std::min(from.opacity, most_opacity), last = std::min(to.opacity, most_opacity);
    const double tau_first = density_of(first, 1), tau_last = density_of(last, 1);
    const double rise = std::abs(tau_last - tau_first);
    const auto value_at = [&](double opacity) {
        const double part = (opacity - from.opacity) / (to.opacity - from.opacity);
        return std::min(to.value, from.value + (to.value - from.value) * part);
    };
    if (first < from.opacity && first != last) {
        out.push_back({value_at(first), tau_first / unit_distance});
    }
    if (rise > 0) {
        auto n_steps = static_cast<std::size_t>(std::max(1.0, std::ceil(rise / std::sqrt(8 * tolerance))));
        while (chord_error(rise / static_cast<double>(n_steps)) > tolerance) {
            ++n_steps;
        }
        for (std::size_t step = 1; step < n_steps; ++step) {
            const double tau = tau_first + (tau_last - tau_first) * (static_cast<double>(step) / static_cast<double>(n_steps));
            out.push_back({value_at(-std::expm1(-tau)), tau / unit_distance});
        }
    }
    if (last < to.opacity && first != last) {
        out.push_back({value_at(last), tau_last / unit_distance});
    }
    out.push_back({to.value, tau_last / unit_distance});
}

/** Appends points between parts `first` and `last` of the way, where straight lines are not near enough. */
void append_curve(const OpacityPoint& from, const OpacityPoint& to, double first, double last, double unit_distance,
                  double tolerance, int depth, std::vector<DensityPoint>& out) {
    const auto tau_at = [&](double t) { return density_of(opacity_between(from, to, t), 1); };
    const double tau_first = tau_at(first), tau_last = tau_at(last);
    bool is_near = true;
    // Eighths may miss the place that is farthest.
    constexpr double seen = 0.9;
    for (int eighth = 1; eighth < 8; ++eighth) {
        const double part = eighth / 8.0;
        const double chord = tau_first + part * (tau_last - tau_first);
        is_near = is_near && std::abs(tau_at(first + part * (last - first)) - chord) <= seen * tolerance;
    }
    constexpr int deepest_opacity_split = 24;
    // Curves are flat at one end and steep at the other: the first splits are not left to what few places tell.
    if (depth >= deepest_opacity_split || (is_near && depth >= 3)) {
        return;
    }
    const double middle = 0.5 * (first + last);
    append_curve(from, to, first, middle, unit_distance, tolerance, depth + 1, out);
    out.push_back({from.value + middle * (to.value - from.value), tau_at(middle) / unit_distance});
    append_curve(from, to, middle, last, unit_distance, tolerance, depth + 1, out);
}

void append(const OpacityPoint& from, const OpacityPoint& to, double unit_distance, double tolerance,
            std::vector<DensityPoint>& out) {
    if (from.value == to.value || from.opacity == to.opacity) {
        out.push_back({to.value, density_of(to.opacity, unit_distance)});
        return;
    }
    const double midpoint = std::clamp(from.midpoint, least_midpoint, 1 - least_midpoint);
    const OpacityPoint middle{from.value + midpoint * (to.value - from.value), 0.5 * (from.opacity + to.opacity)};
    if (from.sharpness < least_sharpness) {
        if (midpoint == 0.5) {
            append_linear(from, to, unit_distance, tolerance, out);
        } else {
            append_linear(from, middle, unit_distance, tolerance, out);
            append_linear(middle, to, unit_distance, tolerance, out);
        }
        return;
    }
    if (from.sharpness > 1 - least_sharpness) {
        out.push_back({middle.value, density_of(from.opacity, unit_distance)});
        out.push_back({middle.value, density_of(to.opacity, unit_distance)});
    } else {
        append_curve(from, to, 0, midpoint, unit_distance, tolerance, 0, out);
        out.push_back({middle.value, density_of(middle.opacity, unit_distance)});
        append_curve(from, to, midpoint, 1, unit_distance, tolerance, 0, out);
    }
    out.push_back({to.value, density_of(to.opacity, unit_distance)});
}

} // namespace

double opacity_between(const OpacityPoint& from, const OpacityPoint& to, double t) {
    const double midpoint = std::clamp(from.midpoint, least_midpoint, 1 - least_midpoint);
    double s = t < midpoint ? 0.5 * t / midpoint : 0.5 + 0.5 * (t - midpoint) / (1 - midpoint);
    if (from.sharpness > 1 - least_sharpness) {
        return s < 0.5 ? from.opacity : to.opacity;
    }
    const double rise = to.opacity - from.opacity;
    if (from.sharpness < least_sharpness) {
        return from.opacity + s * rise;
    }
    // Compressed towards the ends, then a cubic of Hermite's with slope (1 - sharpness) rise at both ends.
    const double power = 1 + 10 * from.sharpness;
    s = s < 0.5 ? 0.5 * std::pow(2 * s, power) : 1 - 0.5 * std::pow(2 * (1 - s), power);
    const double cubic = s * s * (3 - 2 * s) + (1 - from.sharpness) * s * (1 - s) * (1 - 2 * s);
    return from.opacity + rise * std::clamp(cubic, 0.0, 1.0);
}

double density_of(double opacity, double unit_distance) {
    return -std::log1p(-std::min(opacity, most_opacity)) / unit_distance;
}

std::vector<TransferFunction::DensityPoint> density_from_opacity(const std::vector<OpacityPoint>& points,
                                                                 double unit_distance) {
    double largest = 0;
    for (const OpacityPoint& point : points) {
        largest = std::max(largest, density_of(point.opacity, 1));
    }
    std::vector<DensityPoint> out = {{points.front().value, density_of(points.front().opacity, unit_distance)}};
    for (std::size_t i = 1; i < points.size(); ++i) {
        append(points[i - 1], points[i], unit_distance, chord_tolerance * largest, out);
    }
    return out;
}

} // namespace elvis
