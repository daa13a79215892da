#include <core/render/transfer_function.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace elvis {

namespace {

/** One channel just above a value, and how it changes with it up to the next point. */
struct Line {
    double value = 0, slope = 0;
};

template <class Point, class Channel> Line line_above(const std::vector<Point>& points, double value, Channel channel) {
    const auto after = std::upper_bound(points.begin(), points.end(), value, [](double v, const Point& p) { return v < p.value; });
    if (after == points.begin()) {
        return {channel(points.front()), 0};
    }
    const Point& last = *std::prev(after);
    if (after == points.end()) {
        return {channel(last), 0};
    }
    const double slope = (channel(*after) - channel(last)) / (after->value - last.value);
    return {channel(last) + slope * (value - last.value), slope};
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
            throw Error("transfer function", std::string(what) + " has points that do not ascend: " + std::to_string(points[i].value) +
                                                 " after " + std::to_string(points[i - 1].value));
        }
    }
}

TransferPiece piece_from(const TransferFunction& transfer, double value) {
    TransferPiece piece;
    piece.from = value;
    const Line density = line_above(transfer.density, value, [](const auto& point) { return point.density; });
    piece.density = density.value;
    piece.density_slope = density.slope;
    for (std::size_t channel = 0; channel < 3; ++channel) {
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
    piece.rgb = transfer.color.front().rgb;
    return piece;
}

/** Whether the second goes on as the first does. */
bool continues(const TransferPiece& first, const TransferPiece& second) {
    const double since = second.from - first.from;
    const auto is_same = [](double a, double b) { return std::abs(a - b) <= 1e-14 * (std::abs(a) + std::abs(b)); };
    bool all = is_same(first.density_slope, second.density_slope) && is_same(first.density + since * first.density_slope, second.density);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        all = all && is_same(first.rgb_slope[channel], second.rgb_slope[channel]) &&
              is_same(first.rgb[channel] + since * first.rgb_slope[channel], second.rgb[channel]);
    }
    return all;
}

} // namespace

const TransferPiece& TransferTable::piece_at(double value) const {
    const auto above = std::upper_bound(breakpoints.begin(), breakpoints.end(), value);
    return pieces[static_cast<std::size_t>(above - breakpoints.begin())];
}

TransferTable cut_at_breakpoints(const TransferFunction& transfer) {
    check(transfer.density, "density");
    check(transfer.color, "color");
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        if (!(point.density >= 0) || !std::isfinite(point.density)) {
            throw Error("transfer function", "density " + std::to_string(point.density) + " at the value " + std::to_string(point.value) +
                                                 " is not a finite number from 0 on");
        }
    }
    std::vector<double> values;
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        values.push_back(point.value);
    }
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        values.push_back(point.value);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    TransferTable table;
    table.pieces.push_back(piece_below(transfer, values.front()));
    for (const double value : values) {
        const TransferPiece piece = piece_from(transfer, value);
        if (!continues(table.pieces.back(), piece)) {
            table.breakpoints.push_back(value);
            table.pieces.push_back(piece);
        }
    }
    return table;
}

} // namespace elvis
