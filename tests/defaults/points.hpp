/**
 * @file points.hpp
 * A device, and reference points of every shape.
 */
#pragma once

#include <core/vulkan/device.hpp>
#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace elvis::test {

using Point = std::array<double, 3>;

inline const Device& device() {
    static const Device only({}, true);
    return only;
}

inline const char* shape_name(elvis_shape shape) {
    const char* names[] = {"hexahedron", "prism", "pyramid", "tetrahedron"};
    return names[shape];
}

/** From the cube into the shape (Karniadakis & Sherwin). */
inline Point expand(elvis_shape shape, Point eta) {
    auto [x, y, z] = eta;
    if (shape == ELVIS_SHAPE_PRISM || shape == ELVIS_SHAPE_PYRAMID) {
        x = 0.5 * (1 + x) * (1 - z) - 1;
    }
    if (shape == ELVIS_SHAPE_PYRAMID || shape == ELVIS_SHAPE_TETRAHEDRON) {
        y = 0.5 * (1 + y) * (1 - z) - 1;
    }
    if (shape == ELVIS_SHAPE_TETRAHEDRON) {
        x = 0.5 * (1 + x) * (-y - z) - 1;
    }
    return {x, y, z};
}

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
        Point xi = expand(shape, eta);
        for (double& coordinate : xi) {
            coordinate = static_cast<double>(static_cast<float>(coordinate));
        }
        points.push_back(xi);
    }
    return points;
}

} // namespace elvis::test
