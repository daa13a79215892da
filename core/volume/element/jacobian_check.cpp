#include <core/base/infinity.hpp>
#include <core/volume/element/jacobian_check.hpp>

#include <core/volume/element/flat_height.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

/** Elements between two looks at the wish to stop. */
constexpr std::uint64_t jacobian_block = 16384;

/** 125 points spread over the cube around the shape, clipped to it: its corners and centres of edges and faces are among them.
 */
std::vector<double> sample_points(elvis_shape shape) {
    std::vector<double> xi;
    for (int node = 0; node < 125; ++node) {
        const double x = 0.5 * (node % 5) - 1, y = 0.5 * (node / 5 % 5) - 1, z = 0.5 * (node / 25) - 1;
        const bool is_inside = shape == ELVIS_SHAPE_PRISM         ? x + z <= 0
                               : shape == ELVIS_SHAPE_PYRAMID     ? x + z <= 0 && y + z <= 0
                               : shape == ELVIS_SHAPE_TETRAHEDRON ? x + y + z <= -1
                               : shape == ELVIS_SHAPE_TRIANGLE    ? x + y <= 0
                                                                  : true;
        const bool is_needed = z < 0 || (shape != ELVIS_SHAPE_TRIANGLE && shape != ELVIS_SHAPE_QUADRILATERAL);
        if (is_inside && is_needed) {
            xi.insert(xi.end(), {x, y, z});
        }
    }
    return xi;
}

/** In two dimensions of the first two rows and columns. */
double determinant(const double* j, bool is_flat) {
    return is_flat
               ? j[0] * j[4] - j[1] * j[3]
               : j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) + j[2] * (j[3] * j[7] - j[4] * j[6]);
}

JacobianCheck sample(const RuntimeVolume& volume, std::uint64_t element, const std::vector<double>& xi,
                     std::vector<double>& jacobians) {
    jacobians.resize(3 * xi.size());
    volume.evaluate_mapping(element, xi, {}, jacobians);
    const bool is_flat = volume.dimension() == 2;
    JacobianCheck check{ELVIS_JACOBIAN_POSITIVE, {}, infinity, 0};
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        const double value = determinant(&jacobians[9 * point], is_flat);
        const bool is_nan = !std::isfinite(value);
        if (is_nan || value < check.determinant) {
            check = {is_nan      ? ELVIS_JACOBIAN_UNDECIDED
                     : value < 0 ? ELVIS_JACOBIAN_NEGATIVE
                     : value > 0 ? ELVIS_JACOBIAN_POSITIVE
                                 : ELVIS_JACOBIAN_UNDECIDED,
                     {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]},
                     value,
                     is_nan ? -infinity : value};
        }
        if (is_nan) {
            break;
        }
    }
    return check;
}

elvis_certainty sample(const RuntimeVolume& volume, std::uint64_t first, std::span<JacobianCheck> checks) {
    std::vector<double> jacobians;
    for (const ClassInfo& element_class : volume.classes()) {
        const std::vector<double> xi = sample_points(element_class.shape);
        const std::uint64_t end = std::min(first + checks.size(), element_class.first_element + element_class.n_elements);
        for (std::uint64_t element = std::max(first, element_class.first_element); element < end; ++element) {
            checks[element - first] = sample(volume, element, xi, jacobians);
        }
    }
    return ELVIS_ESTIMATED;
}

} // namespace

bool can_check_jacobians(const RuntimeVolume& volume) {
    const bool is_solid = volume.dimension() == 3;
    return (volume.has_jacobian_checks() && is_solid) || (volume.has_evaluation() && (is_solid || flat_height(volume)));
}

JacobianReport check_jacobians(const RuntimeVolume& volume, double tolerance, const TaskControl* control) {
    assert(can_check_jacobians(volume));
    JacobianReport report;
    report.certainty = ELVIS_CERTIFIED;
    report.signs.reserve(volume.n_elements());
    std::vector<JacobianCheck> checks;
    for (std::uint64_t first = 0; first < volume.n_elements(); first += jacobian_block) {
        if (control) {
            control->check();
            control->progress(static_cast<double>(first) / static_cast<double>(volume.n_elements()), "Jacobians");
        }
        checks.assign(std::min(jacobian_block, volume.n_elements() - first), {});
        const elvis_certainty certainty = volume.has_jacobian_checks() && volume.dimension() == 3
                                              ? volume.check_jacobians(first, tolerance, checks)
                                              : sample(volume, first, checks);
        report.certainty = std::max(report.certainty, certainty);
        for (std::uint64_t index = 0; index < checks.size(); ++index) {
            const JacobianCheck& check = checks[index];
            report.signs.push_back(check.sign);
            report.n_positive += check.sign == ELVIS_JACOBIAN_POSITIVE ? 1 : 0;
            report.n_negative += check.sign == ELVIS_JACOBIAN_NEGATIVE ? 1 : 0;
            report.n_undecided += check.sign == ELVIS_JACOBIAN_UNDECIDED ? 1 : 0;
            if (check.sign != ELVIS_JACOBIAN_POSITIVE) {
                report.findings.emplace_back(first + index, check);
            }
        }
    }
    return report;
}

} // namespace elvis
