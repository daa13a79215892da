#include "knots.hpp"

#include "../text.hpp"

#include <algorithm>
#include <cmath>

namespace elvis_mfem {

std::vector<int> KnotVector::spans() const {
    std::vector<int> result;
    for (int span = order; span < n_control_points(); ++span) {
        const auto at = static_cast<std::size_t>(span);
        if (knots[at] < knots[at + 1]) {
            result.push_back(span);
        }
    }
    return result;
}

KnotVector KnotVector::reversed() const {
    KnotVector result = *this;
    std::ranges::transform(knots, result.knots.rbegin(), [&](double knot) { return knots.front() + knots.back() - knot; });
    return result;
}

std::array<double, max_spline_order + 1> KnotVector::evaluate(int span, double t) const {
    const auto knot = [&](int i) { return knots[static_cast<std::size_t>(i)]; };
    const double u = (1 - t) * knot(span) + t * knot(span + 1);
    // De Boor's recurrence, by degree; value[i] is the spline of control point span - degree + i.
    std::array<double, max_spline_order + 1> value{1};
    for (int degree = 1; degree <= order; ++degree) {
        double carried = 0;
        for (int i = 0; i < degree; ++i) {
            const double right = knot(span + 1 + i), left = knot(span + 1 + i - degree);
            const double part = value[static_cast<std::size_t>(i)] / (right - left);
            value[static_cast<std::size_t>(i)] = carried + (right - u) * part;
            carried = (u - left) * part;
        }
        value[static_cast<std::size_t>(degree)] = carried;
    }
    return value;
}

KnotVector read_knot_vector(Text& text) {
    KnotVector result;
    result.order = static_cast<int>(text.integer("the order of a knot vector", 1, max_spline_order));
    const auto n = text.count("the number of control points", 2) + static_cast<std::size_t>(result.order) + 1;
    for (std::size_t i = 0; i < n; ++i) {
        const double knot = text.real("a knot");
        if (!std::isfinite(knot) || (i > 0 && knot < result.knots.back())) {
            text.fail("the knots do not ascend");
        }
        result.knots.push_back(knot);
    }
    const auto at_end = static_cast<std::size_t>(result.order);
    if (n < 2 * (at_end + 1) || result.knots[at_end] > result.knots[0] || result.knots[n - 1 - at_end] < result.knots[n - 1] ||
        result.spans().empty()) {
        text.fail("a knot vector must have its first and its last knot order + 1 times");
    }
    return result;
}

} // namespace elvis_mfem
