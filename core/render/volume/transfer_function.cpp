#include <core/render/volume/transfer_function.hpp>

#include <core/base/error.hpp>
#include <core/render/volume/simpler_colors.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

namespace elvis {

namespace {

/** What rounding may do to a channel, as a part of its largest value: far below what any picture shows. */
constexpr double rounding = 1e-12;

/** One channel just above a value, and how it changes with it up to the next point. */
struct Line {
    double value = 0, slope = 0;
};

template <class Point, class Channel> Line line_above(const std::vector<Point>& points, double value, Channel channel) {
    const auto after =
        std::upper_bound(points.begin(), points.end(), value, [](double v, const Point& p) { return v < p.value; });
    if (after == points.begin()) {
        return {channel(points.front()), 0};
    }
    const Point& last = *std::prev(after);
    if (after == points.end()) {
        return {channel(last), 0};
    }
    const double slope = (channel(*after) - channel(last)) / (after->value - last.value);
    // Points so near to each other that the slope overflows are as good as a step.
    return std::isfinite(slope) ? Line{channel(last) + slope * (value - last.value), slope} : Line{channel(last), 0};
}

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

template <class Point> void check(const std::vector<Point>& points, const char* what) {
    if (points.empty()) {
        throw Error("transfer function", std::string(what) + " has no points");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i].value)) {
            throw Error("transfer function", std::string(what) + " has a point at a value that is not finite");
        }
        if (i > 0 && points[i].value < points[i - 1].value) {
            throw Error("transfer function", std::string(what) + " has points that do not ascend: " + text_of(points[i].value) +
                                                 " after " + text_of(points[i - 1].value));
        }
    }
}

void check(const TransferFunction& transfer) {
    check(transfer.density, "density");
    check(transfer.color, "color");
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        if (!(point.density >= 0) || !std::isfinite(point.density)) {
            throw Error("transfer function", "density " + text_of(point.density) + " at the value " + text_of(point.value) +
                                                 " is not a finite number from 0 on");
        }
    }
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        for (const double channel : point.rgb) {
            if (!std::isfinite(channel)) {
                throw Error("transfer function", "the color at the value " + text_of(point.value) + " is not finite");
            }
        }
    }
}

bool is_empty(const TransferPiece& piece) { return piece.density == 0 && piece.density_slope == 0; }

TransferPiece piece_from(const TransferFunction& transfer, double value) {
    TransferPiece piece;
    piece.from = value;
    const Line density = line_above(transfer.density, value, [](const auto& point) { return point.density; });
    // Rounding can take the end of a ramp below zero.
    piece.density = std::max(0.0, density.value);
    piece.density_slope = density.slope;
    for (std::size_t channel = 0; channel < 3 && !is_empty(piece); ++channel) {
        const Line color = line_above(transfer.color, value, [channel](const auto& point) { return point.rgb[channel]; });
        piece.rgb[channel] = color.value;
        piece.rgb_slope[channel] = color.slope;
    }
    return piece;
}

TransferPiece piece_below(const TransferFunction& transfer, double first) {
    TransferPiece piece;
    piece.from = first;
    piece.density = transfer.density.front().density;
    if (!is_empty(piece)) {
        piece.rgb = transfer.color.front().rgb;
    }
    return piece;
}

/** Whether the second, which reaches up to `end`, goes on as the first does; without end, if `end` is infinite. */
bool continues(const TransferPiece& first, const TransferPiece& second, double end, double largest_density) {
    if (is_empty(first) || is_empty(second)) {
        return is_empty(first) && is_empty(second);
    }
    const double begin = second.from - first.from;
    const auto goes_on = [&](double value, double slope, double next_value, double next_slope, double scale) {
        const double change = next_slope - slope;
        const double jump = next_value - (value + begin * slope);
        // Rounding of a slope would have no bounds beyond the last breakpoint.
        return std::isinf(end) ? change == 0 && std::abs(jump) <= scale * rounding
                               : std::max(std::abs(jump), std::abs(jump + (end - second.from) * change)) <= scale * rounding;
    };
    bool all = goes_on(first.density, first.density_slope, second.density, second.density_slope, largest_density);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        all = all && goes_on(first.rgb[channel], first.rgb_slope[channel], second.rgb[channel], second.rgb_slope[channel], 1);
    }
    return all;
}

} // namespace

const TransferPiece& TransferTable::piece_at(double value) const {
    const auto above = std::upper_bound(breakpoints.begin(), breakpoints.end(), value);
    return pieces[static_cast<std::size_t>(above - breakpoints.begin())];
}

TransferTable cut_at_breakpoints(const TransferFunction& wanted, double color_error) {
    check(wanted);
    TransferTable table;
    TransferFunction transfer = wanted;
    if (color_error > 0) {
        std::vector<TransferFunction::ColorPoint> simpler = simpler_colors(wanted.color, color_error);
        // An error for little would be no bargain.
        if (2 * simpler.size() <= wanted.color.size()) {
            transfer.color = std::move(simpler);
            table.color_error = color_error;
        }
    }
    std::vector<double> values;
    double largest_density = 0;
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        values.push_back(point.value);
        largest_density = std::max(largest_density, point.density);
    }
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        values.push_back(point.value);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    table.pieces.push_back(piece_below(transfer, values.front()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const TransferPiece piece = piece_from(transfer, values[i]);
        const double end = i + 1 < values.size() ? values[i + 1] : std::numeric_limits<double>::infinity();
        if (!continues(table.pieces.back(), piece, end, largest_density)) {
            table.breakpoints.push_back(values[i]);
            table.pieces.push_back(piece);
        }
    }
    return table;
}

} // namespace elvis
