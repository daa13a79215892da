#include "answers_as_json.hpp"

#include <core/base/counted.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis::commands {

namespace {

using nlohmann::ordered_json;

/** `bound`: beyond it lies no value, if it is certified. */
ordered_json extremum_json(double value, double bound, bool is_certified, std::int64_t element, const double* xi,
                           const double* position) {
    ordered_json answer = {{"value", value}};
    if (is_certified) {
        answer["interval"] = {std::min(value, bound), std::max(value, bound)};
    }
    answer["element"] = element;
    answer["xi"] = std::array{xi[0], xi[1], xi[2]};
    if (std::isfinite(position[0])) {
        answer["position"] = std::array{position[0], position[1], position[2]};
    }
    return answer;
}

} // namespace

ordered_json integral_json(const elvis_integral& integral) {
    return {{"value", integral.value},
            {"error", integral.error},
            {"measure", integral.measure},
            {"measure_error", integral.measure_error},
            {"converged", integral.is_converged != 0},
            {"exact", integral.is_exact != 0},
            {"parts", integral.n_parts},
            {"evaluations", integral.n_evaluations}};
}

std::vector<std::string> doubts_of(const elvis_integral& integral) {
    std::vector<std::string> doubts;
    if (integral.n_inverted > 0) {
        doubts.push_back("the Jacobian determinant is negative in " + counted(integral.n_inverted, "element") +
                         ", whose measure counts as positive");
    }
    if (integral.n_unresolved > 0) {
        doubts.push_back("the surface stays undecided in " + counted(integral.n_unresolved, "small place") +
                         "; what they may add is in the errors");
    }
    if (integral.is_converged == 0) {
        doubts.emplace_back("the error is larger than the tolerance");
    }
    return doubts;
}

ordered_json extrema_json(const std::string& field, const elvis_range& range) {
    if (!std::isfinite(range.minimum) || !std::isfinite(range.maximum)) {
        throw Error(field, "is not finite everywhere: it has no extrema");
    }
    if (std::isinf(range.lower_bound) || std::isinf(range.upper_bound)) {
        throw Error(field, "grows without limit, as far as its samples tell: it has no extrema");
    }
    const bool is_certified = range.certainty == ELVIS_CERTIFIED;
    return {{"field", field},
            {"certainty", is_certified ? "certified" : "sampled"},
            {"minimum", extremum_json(range.minimum, range.lower_bound, is_certified, range.minimum_element, range.minimum_xi,
                                      range.minimum_position)},
            {"maximum", extremum_json(range.maximum, range.upper_bound, is_certified, range.maximum_element, range.maximum_xi,
                                      range.maximum_position)}};
}

} // namespace elvis::commands
