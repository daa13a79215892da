/**
 * @file order_checks.cpp
 * Checks that mappings and fields have no higher order than the plugin says.
 *
 * A polynomial of total degree K, or of degree K in one direction, is one of degree K along every line, or along the lines of
 * that direction. So the plugin is evaluated along straight lines through interior points, at more than K + 1 Chebyshev points,
 * and the coefficients beyond T_K must vanish. What follows for a line from `geometry_order` and `order` depends on the shape:
 *
 *   - hexahedron, quadrilateral: along xi_i, order[i].
 *   - prism, tetrahedron, triangle: along xi_i, the largest of the orders. Along oblique lines too if the order is that of the
 * total degree, which the interface leaves open for fields: a note.
 *   - pyramid: along xi1 and xi2, the largest of the orders; along xi3 its spaces may be rational.
 *
 * An affine mapping is of degree 1 along every line.
 */
#include <core/conformance/check.hpp>
#include <core/conformance/differences.hpp>
#include <core/conformance/evaluator.hpp>
#include <core/conformance/reference_points.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <span>

namespace elvis::conformance {

namespace {

constexpr std::size_t n_elements_with_lines = 12;
constexpr std::size_t n_lines = 2; ///< of each direction
/** Degrees beyond the declared one that are told apart; higher ones alias into them. */
constexpr std::size_t n_degrees_beyond = 5;
/** Far above the rounding of sums in double precision, of high orders too, and far below a mode that matters. */
constexpr double order_tolerance = 1e-8;
constexpr std::size_t max_complaints = 5;

struct Direction {
    Point along;
    const char* name;
    /** The smallest degree that the declared orders promise. */
    std::uint32_t degree;
    /** Whether the promise is certain. */
    bool is_certain = true;
};

/** How far xi + t along stays inside of the shape: the interval of t. */
std::pair<double, double> reach(elvis_shape shape, const Point& xi, const Point& along) {
    double low = -std::numeric_limits<double>::infinity();
    double high = -low;
    const auto clip = [&](const Point& normal, double limit) { // normal . x <= limit
        double speed = 0;
        double room = limit;
        for (std::size_t i = 0; i < 3; ++i) {
            speed += normal[i] * along[i];
            room -= normal[i] * xi[i];
        }
        if (speed > 0) {
            high = std::min(high, room / speed);
        } else if (speed < 0) {
            low = std::max(low, room / speed);
        }
    };
    for (std::size_t i = 0; i < 3; ++i) {
        Point normal{};
        normal[i] = 1;
        clip(normal, 1);
        normal[i] = -1;
        clip(normal, 1);
    }
    if (shape == ELVIS_SHAPE_PRISM || shape == ELVIS_SHAPE_PYRAMID) {
        clip({1, 0, 1}, 0);
    }
    if (shape == ELVIS_SHAPE_PYRAMID) {
        clip({0, 1, 1}, 0);
    }
    if (shape == ELVIS_SHAPE_TETRAHEDRON) {
        clip({1, 1, 1}, -1);
    }
    if (shape == ELVIS_SHAPE_TRIANGLE) {
        clip({1, 1, 0}, 0);
    }
    return {low, high};
}

bool is_plane(elvis_shape shape) { return shape == ELVIS_SHAPE_QUADRILATERAL || shape == ELVIS_SHAPE_TRIANGLE; }

std::vector<Direction> directions(elvis_shape shape, std::span<const std::uint32_t, 3> order) {
    const std::uint32_t largest = std::max({order[0], order[1], is_plane(shape) ? 0 : order[2]});
    const bool is_tensor = shape == ELVIS_SHAPE_HEXAHEDRON || shape == ELVIS_SHAPE_QUADRILATERAL;
    std::vector<Direction> found{{{1, 0, 0}, "xi1", is_tensor ? order[0] : largest},
                                 {{0, 1, 0}, "xi2", is_tensor ? order[1] : largest}};
    if (!is_plane(shape) && shape != ELVIS_SHAPE_PYRAMID) {
        found.push_back({{0, 0, 1}, "xi3", is_tensor ? order[2] : largest});
    }
    if (shape == ELVIS_SHAPE_TRIANGLE) {
        found.push_back({{1, -1, 0}, "xi1 - xi2", largest, false});
    } else if (shape == ELVIS_SHAPE_PRISM) {
        found.push_back({{1, 0, -1}, "xi1 - xi3", largest, false});
    } else if (shape == ELVIS_SHAPE_TETRAHEDRON) {
        found.push_back({{1, 1, -2}, "xi1 + xi2 - 2 xi3", largest, false});
    }
    return found;
}

Direction oblique(elvis_shape shape) {
    return is_plane(shape) ? Direction{{1, 0.7, 0}, "xi1 + 0.7 xi2", 1}
                           : Direction{{1, 0.7, 0.6}, "xi1 + 0.7 xi2 + 0.6 xi3", 1};
}

/** The smallest degree that represents values at Chebyshev points of the first kind, in the order of cos((k + 1/2) pi / n). */
std::uint32_t degree_of(const std::vector<double>& values) {
    const std::size_t n = values.size();
    const auto [low, high] = std::ranges::minmax(values);
    const double limit = order_tolerance * (high - low) + 1e-12 * std::max(std::abs(low), std::abs(high));
    for (std::size_t degree = n - 1; degree > 0; --degree) {
        double coefficient = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
            coefficient += 2.0 / static_cast<double>(n) * values[k] * std::cos(static_cast<double>(degree) * angle);
        }
        if (std::abs(coefficient) > limit) {
            return static_cast<std::uint32_t>(degree);
        }
    }
    return 0;
}

/** Values at points of the element, one row a quantity. */
using Sampler = std::function<std::vector<std::vector<double>>(const std::vector<Point>&)>;

/** The highest degree found along lines of the direction. */
std::uint32_t degree_along(elvis_shape shape, const Direction& direction, std::uint64_t seed, const Sampler& sample) {
    std::uint32_t highest = 0;
    for (const Point& middle : interior_points(shape, n_lines, seed)) {
        const auto [low, high] = reach(shape, middle, direction.along);
        const std::size_t n = direction.degree + 1 + n_degrees_beyond;
        std::vector<Point> xi(n, middle);
        for (std::size_t k = 0; k < n; ++k) {
            const double c = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
            for (std::size_t i = 0; i < 3; ++i) {
                xi[k][i] += (0.5 * (low + high) + 0.5 * (high - low) * c) * direction.along[i];
            }
        }
        for (const std::vector<double>& values : sample(xi)) {
            highest = std::max(highest, degree_of(values));
        }
    }
    return highest;
}

std::string text_of_orders(std::span<const std::uint32_t, 3> order, elvis_shape shape) {
    const std::string two = std::to_string(order[0]) + ' ' + std::to_string(order[1]);
    return is_plane(shape) ? two : two + ' ' + std::to_string(order[2]);
}

class OrderCheck {
public:
    OrderCheck(Context& context, const RuntimeVolume& volume)
        : m_context(context), m_volume(volume), m_evaluator(context, volume) {}

    void mapping(std::uint32_t element_class, std::uint64_t element) {
        const ClassInfo& info = m_volume.classes()[element_class];
        const Sampler sample = [&](const std::vector<Point>& xi) {
            std::vector<std::vector<double>> found(3, std::vector<double>(xi.size()));
            const std::vector<Point> positions = m_evaluator.positions(element, xi);
            for (std::size_t k = 0; k < xi.size(); ++k) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    found[axis][k] = positions[k][axis];
                }
            }
            return found;
        };
        const std::uint64_t seed = m_context.subject().seed + element;
        const std::string where = "get_class: class " + std::to_string(element_class) + ": ";
        if (info.is_affine) {
            const Direction line = oblique(info.shape);
            const std::uint32_t found = degree_along(info.shape, line, seed, sample);
            if (found > 1) {
                complain(where, where + "is_affine is set, but the mapping of element " + std::to_string(element) +
                                    " is of degree " + degree_text(line, found) + " along " + line.name +
                                    " (mesh lines are drawn straight, and bounds of coordinates are too small)");
            }
        }
        const std::span<const std::uint32_t, 3> order(info.geometry_order);
        if (order[0] > 0 && order[1] > 0) {
            compare(where, "geometry_order", "the mapping", element, info.shape, order, seed, sample);
        }
    }

    void field(std::uint32_t element_class, std::uint32_t field, std::uint64_t element) {
        const elvis_shape shape = m_volume.classes()[element_class].shape;
        const FieldInfo& info = m_volume.fields()[field];
        const ClassFieldInfo class_field = m_volume.class_field(element_class, field);
        const auto count = is_plane(shape) ? 2 : 3;
        // With a transform, the order is that of what is stored.
        if (info.transform != ELVIS_TRANSFORM_NONE ||
            std::any_of(class_field.order, class_field.order + count, [](auto k) { return k < 0; })) {
            return;
        }
        std::array<std::uint32_t, 3> order{};
        std::copy_n(class_field.order, count, order.begin());
        const Sampler sample = [&](const std::vector<Point>& xi) {
            std::vector<std::vector<double>> found;
            for (std::uint32_t component = 0; component < std::min(info.n_components, 3u); ++component) {
                found.emplace_back();
                for (const auto& [value, gradient] : m_evaluator.values(element, xi, component)) {
                    found.back().push_back(value);
                }
            }
            return found;
        };
        compare("get_class_field: class " + std::to_string(element_class) + ": ", "order", "field " + info.name, element, shape,
                order, m_context.subject().seed + element, sample);
    }

    Evaluator& evaluator() { return m_evaluator; }

private:
    /** "2", or "7 or more" where the samples do not tell. */
    static std::string degree_text(const Direction& direction, std::uint32_t found) {
        return std::to_string(found) + (found >= direction.degree + n_degrees_beyond - 1 ? " or more" : "");
    }

    void compare(const std::string& where, const char* member, const std::string& what, std::uint64_t element,
                 elvis_shape shape, std::span<const std::uint32_t, 3> order, std::uint64_t seed, const Sampler& sample) {
        for (const Direction& direction : directions(shape, order)) {
            const std::uint32_t found = degree_along(shape, direction, seed, sample);
            if (found <= direction.degree) {
                continue;
            }
            const std::string said = where + member + " is " + text_of_orders(order, shape) + ", but " + what +
                                     " is of degree " + degree_text(direction, found) + " along " + direction.name +
                                     " in element " + std::to_string(element);
            if (!direction.is_certain) {
                if (m_noted.insert(where + what).second) {
                    m_context.note(said + ": `elvis export` takes the largest order for the total degree and is not exact");
                }
                continue;
            }
            complain(
                where + what,
                said + " by " + m_evaluator.name() +
                    ": what rests on the order is wrong (`elvis export` loses what is above it, mesh lines miss bent edges)");
            return;
        }
    }

    /** One complaint for each class and quantity. */
    void complain(const std::string& about, const std::string& what) {
        if (m_complaints.insert(about).second && m_complaints.size() <= max_complaints) {
            m_context.fail(what);
        }
    }

    Context& m_context;
    const RuntimeVolume& m_volume;
    Evaluator m_evaluator;
    std::set<std::string> m_complaints, m_noted;
};

void check_orders(Context& context) {
    context.need_runtime_volume();
    context.progress("open");
    const RuntimeVolume volume(context.plugin(), context.subject().files.front(), context.subject().options);
    OrderCheck check(context, volume);
    const std::vector<std::uint64_t> elements = some_elements(volume, n_elements_with_lines, context.subject().seed);
    for (const std::uint64_t element : elements) {
        context.progress("mapping of element " + std::to_string(element));
        check.mapping(class_of(volume, element), element);
    }
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        check.evaluator().select(field);
        for (const std::uint64_t element : elements) {
            context.progress("field " + volume.fields()[field].name + " in element " + std::to_string(element));
            check.field(class_of(volume, element), field, element);
        }
    }
}

} // namespace

std::vector<Check> order_checks() {
    return {{"orders", "mappings and fields have no higher order than geometry_order, is_affine and order say", check_orders}};
}

} // namespace elvis::conformance
