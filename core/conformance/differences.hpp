/**
 * @file differences.hpp
 * Derivatives by differences, and numbers as text.
 */
#pragma once

#include <core/conformance/reference_points.hpp>

#include <functional>
#include <string>
#include <vector>

namespace elvis::conformance {

/** Some numbers at each point. */
using PointFunction = std::function<std::vector<std::vector<double>>(const std::vector<Point>& points)>;

/**
 * Derivatives by xi_j of every number at every point: central differences of sixth order with a step of 2^-9, so that in double
 * precision truncation (h^6 f^(7) / 140, f^(7) up to 1e8) and rounding (1.8 eps f / h) both stay below 1e-9 or so.
 */
std::vector<std::vector<double>> differences(const std::vector<Point>& xi, std::size_t j, const PointFunction& function);

/** Numbers cut into rows of `width`. */
std::vector<std::vector<double>> rows(const std::vector<double>& numbers, std::size_t width);

/** With all digits, and with three. */
std::string text_of(double number);
std::string text_of(const Point& point);
std::string short_text(double number);

} // namespace elvis::conformance
