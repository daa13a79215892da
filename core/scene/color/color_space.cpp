#include <core/scene/color/color_space.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

using Triple = std::array<double, 3>;
constexpr double pi = std::numbers::pi;
/** D65. */
constexpr Triple white = {0.95047, 1.0, 1.08883};

Triple mix(const Triple& a, const Triple& b, double t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double from_linear(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

/** The cube root of CIE 1976, linear near zero. */
double lab_root(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; }
double lab_cube(double t) { return t > 6.0 / 29 ? t * t * t : (116 * t - 16) * 27 / 24389; }

Triple to_lab(const Rgb& rgb) {
    const double r = to_linear(rgb[0]), g = to_linear(rgb[1]), b = to_linear(rgb[2]);
    const double x = lab_root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / white[0]);
    const double y = lab_root((0.2126729 * r + 0.7151522 * g + 0.0721750 * b) / white[1]);
    const double z = lab_root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Rgb from_lab(const Triple& lab) {
    const double fy = (lab[0] + 16) / 116;
    const double x = white[0] * lab_cube(fy + lab[1] / 500);
    const double y = white[1] * lab_cube(fy);
    const double z = white[2] * lab_cube(fy - lab[2] / 200);
    return {from_linear(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
            from_linear(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
            from_linear(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

/** Moreland's polar form: M = |Lab|, s = angle from the lightness axis, h = hue. */
Triple to_msh(const Rgb& rgb) {
    const Triple lab = to_lab(rgb);
    const double m = std::sqrt(lab[0] * lab[0] + lab[1] * lab[1] + lab[2] * lab[2]);
    const double s = m > 0.001 ? std::acos(std::clamp(lab[0] / m, -1.0, 1.0)) : 0;
    return {m, s, s > 0.001 ? std::atan2(lab[2], lab[1]) : 0};
}

Rgb from_msh(const Triple& msh) {
    return from_lab({msh[0] * std::cos(msh[1]), msh[0] * std::sin(msh[1]) * std::cos(msh[2]),
                     msh[0] * std::sin(msh[1]) * std::sin(msh[2])});
}

/** Hue for an unsaturated end, so that lightness and saturation alone seem to change. */
double adjusted_hue(const Triple& saturated, double m_unsaturated) {
    if (saturated[0] >= m_unsaturated - 0.1) {
        return saturated[2];
    }
    const double spin = saturated[1] * std::sqrt(m_unsaturated * m_unsaturated - saturated[0] * saturated[0]) /
                        (saturated[0] * std::sin(saturated[1]));
    return saturated[2] > -pi / 3 ? saturated[2] + spin : saturated[2] - spin;
}

Rgb diverging(const Rgb& from, const Rgb& to, double t) {
    Triple first = to_msh(from), last = to_msh(to);
    double difference = std::abs(first[2] - last[2]);
    difference = difference > pi ? 2 * pi - difference : difference;
    if (first[1] > 0.05 && last[1] > 0.05 && difference > pi / 3) {
        const double middle = std::max({first[0], last[0], 88.0});
        if (t < 0.5) {
            last = {middle, 0, 0};
            t *= 2;
        } else {
            first = {middle, 0, 0};
            t = 2 * t - 1;
        }
    }
    if (first[1] < 0.05 && last[1] > 0.05) {
        first[2] = adjusted_hue(last, first[0]);
    } else if (first[1] > 0.05 && last[1] < 0.05) {
        last[2] = adjusted_hue(first, last[0]);
    }
    return from_msh(mix(first, last, t));
}

Triple to_hsv(const Rgb& rgb) {
    const double high = std::max({rgb[0], rgb[1], rgb[2]}), low = std::min({rgb[0], rgb[1], rgb[2]});
    const double spread = high - low;
    double hue = 0;
    if (spread > 0) {
        hue = high == rgb[0]   ? (rgb[1] - rgb[2]) / spread
              : high == rgb[1] ? 2 + (rgb[2] - rgb[0]) / spread
                               : 4 + (rgb[0] - rgb[1]) / spread;
    }
    return {hue < 0 ? hue + 6 : hue, high > 0 ? spread / high : 0, high};
}

Rgb from_hsv(const Triple& hsv) {
    const auto channel = [&](double offset) {
        const double k = std::fmod(offset + hsv[0] + 6, 6.0);
        return hsv[2] - hsv[2] * hsv[1] * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    };
    return {channel(5), channel(3), channel(1)};
}

Rgb through_hsv(const Rgb& from, const Rgb& to, double t) {
    Triple first = to_hsv(from), last = to_hsv(to);
    if (last[0] - first[0] > 3) {
        first[0] += 6;
    } else if (first[0] - last[0] > 3) {
        last[0] += 6;
    }
    return from_hsv(mix(first, last, t));
}

} // namespace

Rgb interpolate(ColorSpace space, const Rgb& from, const Rgb& to, double t) {
    Rgb color = t <= 0 ? from : to;
    if (t > 0 && t < 1) {
        color = space == ColorSpace::lab         ? from_lab(mix(to_lab(from), to_lab(to), t))
                : space == ColorSpace::diverging ? diverging(from, to, t)
                : space == ColorSpace::hsv       ? through_hsv(from, to, t)
                : space == ColorSpace::step      ? from
                                                 : mix(from, to, t);
    }
    for (double& channel : color) {
        channel = std::clamp(channel, 0.0, 1.0);
    }
    return color;
}

} // namespace elvis
