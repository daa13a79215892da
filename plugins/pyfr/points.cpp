#include "points.hpp"

#include "simplex_rules.hpp"

#include <plugins/nodal/nodal_space.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace elvis_pyfr {

using elvis::native::Shape;

namespace {

/** Points of a rule on [-1, 1]. */
std::vector<double> line(const std::string& rule, std::size_t n) {
    std::vector<double> points(n, 0.0), weights(n);
    if (rule == "gauss-legendre") {
        elvis::native::gauss_legendre(points, weights);
    } else if (rule == "gauss-legendre-lobatto") {
        // A single one lies in the middle.
        if (n > 1) {
            elvis::native::gauss_lobatto_legendre(points);
        }
    } else {
        throw std::invalid_argument("'" + rule + "' is a rule that is not known on lines");
    }
    return points;
}

/** x fastest. */
std::vector<double> tensor(const std::string& rule, std::size_t n_line, std::size_t dimension) {
    const std::vector<double> x = line(rule, n_line);
    std::vector<double> points;
    for (std::size_t k = 0; k < (dimension == 3 ? n_line : 1); ++k) {
        for (std::size_t j = 0; j < n_line; ++j) {
            for (std::size_t i = 0; i < n_line; ++i) {
                points.insert(points.end(), {x[i], x[j]});
                if (dimension == 3) {
                    points.push_back(x[k]);
                }
            }
        }
    }
    return points;
}

/**
 * Layers at the points of a line, each a tensor product that has one point less than the one below. Where the last one is the
 * apex, PyFR's tables begin with it.
 */
std::vector<double> pyramid(const std::string& rule, std::size_t n_line) {
    const std::vector<double> heights = line(rule, n_line);
    const bool begins_at_apex = n_line > 1 && heights.back() == 1;
    std::vector<double> points = begins_at_apex ? std::vector<double>{0, 0, 1} : std::vector<double>{};
    for (std::size_t layer = 0; layer < n_line - (begins_at_apex ? 1 : 0); ++layer) {
        const double z = heights[layer];
        const std::vector<double> x = line(rule, n_line - layer);
        for (const double y : x) {
            for (const double one : x) {
                points.insert(points.end(), {one * (1 - z) / 2, y * (1 - z) / 2, z});
            }
        }
    }
    return points;
}

std::vector<double> numbers_in(const std::string& text) {
    std::string without_brackets = text;
    std::ranges::replace_if(
        without_brackets, [](char one) { return std::string_view("()[],").find(one) != std::string_view::npos; }, ' ');
    std::istringstream words(without_brackets);
    std::vector<double> numbers;
    for (double number = 0; words >> number;) {
        numbers.push_back(number);
    }
    return numbers;
}

/** Coordinates in place of a rule's name; a weight may follow those of each point. */
std::vector<double> listed(const Kind& kind, const std::string& text, std::size_t n) {
    const auto dimension = static_cast<std::size_t>(elvis::native::dimension(kind.shape));
    const std::vector<double> numbers = numbers_in(text);
    const std::size_t width = n == 0 ? 0 : numbers.size() / n;
    if (numbers.size() != width * n || (width != dimension && width != dimension + 1)) {
        throw std::invalid_argument("'" + text.substr(0, 40) + "' is neither a rule nor the coordinates of " +
                                    std::to_string(n) + " points");
    }
    std::vector<double> points;
    for (std::size_t first = 0; first < numbers.size(); first += width) {
        points.insert(points.end(), &numbers[first], &numbers[first] + dimension);
    }
    return points;
}

std::vector<double> tabulated(const Kind& kind, const std::string& rule, std::size_t n) {
    std::vector<double> points = simplex_points(kind, rule, n);
    if (points.empty()) {
        throw std::invalid_argument("the " + std::to_string(n) + " points of '" + rule + "' on " + std::string(kind.name) +
                                    " are not known; solutions of PyFR 3.0 and later hold their points");
    }
    return points;
}

/** Points of a triangle, for each of a line. */
std::vector<double> prism(const std::string& rule, std::size_t n_line) {
    const std::size_t split = rule.find('~');
    if (split == std::string::npos) {
        throw std::invalid_argument("'" + rule + "' is no rule of a triangle and of a line");
    }
    const std::vector<double> triangle = solution_points(*find_kind("tri"), rule.substr(0, split), n_line * (n_line + 1) / 2);
    std::vector<double> points;
    for (const double z : line(rule.substr(split + 1), n_line)) {
        for (std::size_t point = 0; point < triangle.size(); point += 2) {
            points.insert(points.end(), {triangle[point], triangle[point + 1], z});
        }
    }
    return points;
}

bool is_name(const std::string& rule) { return rule.find_first_of(" \t\n(),") == std::string::npos; }

} // namespace

std::vector<double> solution_points(const Kind& kind, const std::string& rule, std::size_t n) {
    const int order = elvis::nodal::order_of(kind.shape, n, most_order(kind));
    if (order < 0) {
        throw std::invalid_argument(std::to_string(n) + " is the number of points of no order up to " +
                                    std::to_string(most_order(kind)));
    }
    const auto n_line = static_cast<std::size_t>(order) + 1;
    if (!is_name(rule)) {
        return listed(kind, rule, n);
    }
    switch (kind.shape) {
    case Shape::hexahedron:
    case Shape::quadrilateral:
        return tensor(rule, n_line, static_cast<std::size_t>(elvis::native::dimension(kind.shape)));
    case Shape::pyramid:
        return pyramid(rule, n_line);
    case Shape::prism:
        return prism(rule, n_line);
    default:
        return tabulated(kind, rule, n);
    }
}

} // namespace elvis_pyfr
