/**
 * @file points.hpp
 * The device, and reference points of every shape.
 */
#pragma once

#include <elvis/element.h>
#include <elvis/native/space.hpp>
#include <tests/support/device.hpp>

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace elvis::test {

using native::Point;

inline std::string_view shape_name(elvis_shape shape) { return native::name(native::Shape{shape}); }

/** Points all over the shape, exact in float32; `on_boundary`: faces, edges and corners too, and points close to them. */
inline std::vector<Point> points_in(elvis_shape shape, int count, bool on_boundary) {
    std::mt19937 random(7);
    const auto number = [&random](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
        Point eta;
        for (double& coordinate : eta) {
            coordinate = number(-0.8, 0.8);
            if (on_boundary && random() % 2 == 0) {
                const double distance = random() % 2 == 0 ? 0.0 : number(0, 0.05);
                coordinate = random() % 2 == 0 ? 1 - distance : distance - 1;
            }
        }
        Point xi = native::expand(native::Shape{shape}, eta);
        for (double& coordinate : xi) {
            coordinate = static_cast<double>(static_cast<float>(coordinate));
        }
        points.push_back(xi);
    }
    return points;
}

} // namespace elvis::test
