/**
 * @file fixture.hpp
 * What tests of scenes and transfer functions share.
 */
#pragma once

#include <core/render/volume/transfer_function.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <random>
#include <string>

namespace elvis::test {

/**
 * A channel at a value, straight from the definition and unlike the program's: from the last point that is not above the value
 * towards the one after.
 */
template <class Point, class Channel> double interpolated(const std::vector<Point>& points, double value, Channel channel) {
    if (value < points.front().value) {
        return channel(points.front());
    }
    for (std::size_t i = points.size() - 1; i > 0; --i) {
        if (points[i].value <= value) {
            if (i + 1 == points.size()) {
                return channel(points[i]);
            }
            const double t = (value - points[i].value) / (points[i + 1].value - points[i].value);
            return (1 - t) * channel(points[i]) + t * channel(points[i + 1]);
        }
    }
    if (points.size() == 1) {
        return channel(points[0]);
    }
    const double t = (value - points[0].value) / (points[1].value - points[0].value);
    return (1 - t) * channel(points[0]) + t * channel(points[1]);
}

inline double density_at(const TransferFunction& transfer, double value) {
    return interpolated(transfer.density, value, [](const auto& point) { return point.density; });
}

inline double color_at(const TransferFunction& transfer, double value, std::size_t channel) {
    return interpolated(transfer.color, value, [channel](const auto& point) { return point.rgb[channel]; });
}

} // namespace elvis::test
