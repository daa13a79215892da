#include <core/conformance/differences.hpp>

#include <array>
#include <cstdio>

namespace elvis::conformance {

std::vector<std::vector<double>> differences(const std::vector<Point>& xi, std::size_t j, const PointFunction& function) {
    constexpr double step = 0x1p-9;
    constexpr std::array<double, 6> weights{-1.0 / 60, 9.0 / 60, -45.0 / 60, 45.0 / 60, -9.0 / 60, 1.0 / 60};
    constexpr std::array<int, 6> places{-3, -2, -1, 1, 2, 3};
    std::vector<Point> points;
    for (const Point& point : xi) {
        for (const int place : places) {
            Point at = point;
            at[j] += place * step;
            points.push_back(at);
        }
    }
    const auto values = function(points);
    std::vector<std::vector<double>> derivatives(xi.size());
    for (std::size_t i = 0; i < xi.size(); ++i) {
        derivatives[i].assign(values[6 * i].size(), 0.0);
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t n = 0; n < derivatives[i].size(); ++n) {
                derivatives[i][n] += weights[k] / step * values[6 * i + k][n];
            }
        }
    }
    return derivatives;
}

std::vector<std::vector<double>> rows(const std::vector<double>& numbers, std::size_t width) {
    std::vector<std::vector<double>> all;
    for (std::size_t first = 0; first + width <= numbers.size(); first += width) {
        all.emplace_back(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                         numbers.begin() + static_cast<std::ptrdiff_t>(first + width));
    }
    return all;
}

std::string text_of(double number) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", number);
    return text.data();
}

std::string text_of(const Point& point) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), "(%.9g, %.9g, %.9g)", point[0], point[1], point[2]);
    return text.data();
}

std::string short_text(double number) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.3g", number);
    return text.data();
}

} // namespace elvis::conformance
