#include <core/scene/color/transfer.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** A tenth of what a picture may be off. */
constexpr double mix_tolerance = 1e-4;
constexpr int deepest_peak_split = 12;

enum class Side { below, above };

/** A channel at a value, which at a step is different on its two sides. */
template <class Point, class Channel>
double channel_at(const std::vector<Point>& points, double value, Side side, Channel channel) {
    const auto is_less = [](const Point& point, double v) { return point.value < v; };
    const auto is_above = [](double v, const Point& point) { return v < point.value; };
    const auto next = side == Side::below ? std::lower_bound(points.begin(), points.end(), value, is_less)
                                          : std::upper_bound(points.begin(), points.end(), value, is_above);
    if (next == points.begin()) {
        return channel(points.front());
    }
    const Point& last = *std::prev(next);
    if (next == points.end() || last.value == value) {
        return channel(last);
    }
    if (next->value == value) {
        return channel(*next);
    }
    return channel(last) + (channel(*next) - channel(last)) * ((value - last.value) / (next->value - last.value));
}

double density_at(const std::vector<TransferFunction::DensityPoint>& points, double value, Side side) {
    return points.empty() ? 0 : channel_at(points, value, side, [](const auto& point) { return point.density; });
}

Rgb color_at(const std::vector<TransferFunction::ColorPoint>& points, double value, Side side) {
    Rgb rgb{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        rgb[channel] = channel_at(points, value, side, [channel](const auto& point) { return point.rgb[channel]; });
    }
    return rgb;
}

double begin_of(const ScenePeak& peak) { return peak.value - 0.5 * peak.width; }
double end_of(const ScenePeak& peak) { return peak.value + 0.5 * peak.width; }

double density_at(const ScenePeak& peak, double value) {
    const double begin = begin_of(peak), end = end_of(peak);
    return value <= begin || value >= end ? 0
           : value < peak.value           ? peak.density * ((value - begin) / (peak.value - begin))
                                          : peak.density * ((end - value) / (end - peak.value));
}

/** Density with one colour at each end, both linear in between: what one peak or the rest adds to an interval. */
struct Part {
    std::array<double, 2> density;
    std::array<Rgb, 2> rgb;

    double density_at(double t) const { return density[0] + t * (density[1] - density[0]); }
};

/** Mean of the parts' colours by density, at part t of the interval. */
Rgb mean_color(const std::vector<Part>& parts, double t) {
    double sum = 0;
    for (const Part& part : parts) {
        sum += part.density_at(t);
    }
    // Where all densities are zero, at an end, the limit: they leave it as their slopes say.
    const double at = sum > 0 ? t : 0.5;
    Rgb mean{};
    double weights = 0;
    for (const Part& part : parts) {
        const double weight = part.density_at(at);
        weights += weight;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            mean[channel] += weight * (part.rgb[0][channel] + t * (part.rgb[1][channel] - part.rgb[0][channel]));
        }
    }
    for (double& channel : mean) {
        channel /= weights;
    }
    return mean;
}

/** Appends points between parts `first` and `last` of an interval until straight lines between them are near enough. */
void refine(const std::vector<Part>& parts, const std::array<double, 2>& interval, double first, double last, int depth,
            std::vector<TransferFunction::ColorPoint>& out) {
    const Rgb from = mean_color(parts, first), to = mean_color(parts, last);
    bool is_near = true;
    for (const double part : {0.25, 0.5, 0.75}) {
        const Rgb exact = mean_color(parts, first + part * (last - first));
        for (std::size_t channel = 0; channel < 3; ++channel) {
            is_near =
                is_near && std::abs(exact[channel] - (from[channel] + part * (to[channel] - from[channel]))) <= mix_tolerance;
        }
    }
    if (is_near || depth >= deepest_peak_split) {
        return;
    }
    const double middle = 0.5 * (first + last);
    refine(parts, interval, first, middle, depth + 1, out);
    out.push_back({interval[0] + middle * (interval[1] - interval[0]), mean_color(parts, middle)});
    refine(parts, interval, middle, last, depth + 1, out);
}

/** Values at which one of the functions may bend or step, each once. */
std::vector<double> bends(std::span<const ScenePeak> peaks, const TransferFunction& transfer, bool with_colors) {
    std::vector<double> values;
    for (const ScenePeak& peak : peaks) {
        values.insert(values.end(), {begin_of(peak), peak.value, end_of(peak)});
    }
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        values.push_back(point.value);
    }
    for (std::size_t i = 0; with_colors && i < transfer.color.size(); ++i) {
        values.push_back(transfer.color[i].value);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::vector<TransferFunction::DensityPoint> summed_density(std::span<const ScenePeak> peaks, const TransferFunction& transfer) {
    std::vector<TransferFunction::DensityPoint> sum;
    for (const double value : bends(peaks, transfer, false)) {
        double of_peaks = 0;
        for (const ScenePeak& peak : peaks) {
            of_peaks += density_at(peak, value);
        }
        const double below = density_at(transfer.density, value, Side::below),
                     above = density_at(transfer.density, value, Side::above);
        sum.push_back({value, below + of_peaks});
        if (above != below) {
            sum.push_back({value, above + of_peaks});
        }
    }
    return sum;
}

/** What there is of density in an interval, of which none of the functions bends inside. */
std::vector<Part> parts_of(std::span<const ScenePeak> peaks, const TransferFunction& transfer,
                           const std::array<double, 2>& interval) {
    const std::array<Rgb, 2> base = {color_at(transfer.color, interval[0], Side::above),
                                     color_at(transfer.color, interval[1], Side::below)};
    std::vector<Part> parts = {
        {{density_at(transfer.density, interval[0], Side::above), density_at(transfer.density, interval[1], Side::below)},
         base}};
    for (const ScenePeak& peak : peaks) {
        const std::array<double, 2> density = {density_at(peak, interval[0]), density_at(peak, interval[1])};
        if (peak.color) {
            parts.push_back({density, {*peak.color, *peak.color}});
        } else {
            parts.front().density[0] += density[0];
            parts.front().density[1] += density[1];
        }
    }
    std::erase_if(parts, [](const Part& part) { return part.density[0] == 0 && part.density[1] == 0; });
    return parts.empty() ? std::vector<Part>{{{0, 0}, base}} : parts;
}

std::vector<TransferFunction::ColorPoint> mixed_colors(std::span<const ScenePeak> peaks, const TransferFunction& transfer) {
    const std::vector<double> values = bends(peaks, transfer, true);
    std::vector<TransferFunction::ColorPoint> mixed = {{values.front(), color_at(transfer.color, values.front(), Side::below)}};
    const auto add = [&mixed](double value, const Rgb& rgb) {
        if (mixed.back().value != value || mixed.back().rgb != rgb) {
            mixed.push_back({value, rgb});
        }
    };
    for (std::size_t i = 1; i < values.size(); ++i) {
        const std::array<double, 2> interval = {values[i - 1], values[i]};
        const std::vector<Part> parts = parts_of(peaks, transfer, interval);
        if (parts.size() == 1) {
            // Its colour as it is, without the rounding of a mean.
            add(interval[0], parts.front().rgb[0]);
            add(interval[1], parts.front().rgb[1]);
            continue;
        }
        add(interval[0], mean_color(parts, 0));
        refine(parts, interval, 0, 1, 0, mixed);
        add(interval[1], mean_color(parts, 1));
    }
    add(values.back(), color_at(transfer.color, values.back(), Side::above));
    return mixed;
}

} // namespace

void add_peaks(std::span<const ScenePeak> peaks, TransferFunction& transfer) {
    if (peaks.empty()) {
        return;
    }
    const bool is_colored =
        std::any_of(peaks.begin(), peaks.end(), [](const ScenePeak& peak) { return peak.color.has_value(); });
    std::vector<TransferFunction::DensityPoint> density = summed_density(peaks, transfer);
    if (is_colored) {
        transfer.color = mixed_colors(peaks, transfer);
    }
    transfer.density = std::move(density);
}

} // namespace elvis
