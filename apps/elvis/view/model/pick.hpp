/**
 * @file pick.hpp
 * What is known of a point that the user clicked on.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

struct Picked {
    /** Nothing was hit: then the rest is empty. */
    bool is_hit = false;
    Vector3 position{};
    double depth = 0;
    Vector3 normal{};
    /** Of the field that the surface shows, as drawn. */
    double shown_value = 0;

    /** Number of the element, as people know it; none outside of the volume. */
    std::optional<std::int64_t> element;
    Vector3 xi{};
    /** Determinant of the mapping's Jacobian, with columns of unit length, and the largest order of the first field. */
    std::optional<double> jacobian, scaled_jacobian, order;
    struct Field {
        std::string name, unit;
        std::vector<double> values;    ///< by component
        std::vector<double> gradients; ///< three numbers a component
        bool gradient_is_estimated = false;
    };
    std::vector<Field> fields;
    /** Other elements that contain the point. */
    std::vector<std::int64_t> also;
    /** Why something is missing. */
    std::string remark;
};

/** As text, for people. */
std::string text_of(const Picked& picked);

} // namespace elvis::view
