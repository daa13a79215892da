/**
 * @file formula.hpp
 * Functions of x, y and z from text, for implicit surfaces.
 */
#pragma once

#include <core/oracle/element/reference_shape.hpp>

#include <functional>
#include <optional>
#include <string_view>

namespace elvis::oracle {

/** A value and its gradient in world coordinates. */
struct Slope {
    double value = 0;
    Vector gradient = Vector::Zero();
};

using Formula = std::function<Slope(const Vector& x)>;

/**
 * Numbers, x, y, z, + - *, ^ with a whole number, sin, cos, exp and brackets: functions that are smooth everywhere. Nothing for
 * any other text. What the program reads is more (core/expression), and is read in another way.
 */
std::optional<Formula> parse_formula(std::string_view text);

} // namespace elvis::oracle
