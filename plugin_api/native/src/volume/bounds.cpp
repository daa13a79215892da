/*
 * Bounds of elements, ranges of fields and signs of Jacobians, certified by the native spaces.
 */
#include "volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::native_plugin {
namespace {

/** Points in every collapsed direction for ranges that cannot be certified. */
constexpr int samples_per_direction = 6;

/** A grid over the closed reference shape: corners, edges and faces are among its points. */
std::vector<double> sample_points(native::Shape shape) {
    std::vector<double> points;
    const auto coordinate = [](int i) { return 2.0 * i / (samples_per_direction - 1) - 1; };
    for (int k = 0; k < samples_per_direction; ++k)
        for (int j = 0; j < samples_per_direction; ++j)
            for (int i = 0; i < samples_per_direction; ++i) {
                const native::Point xi = native::expand(shape, {coordinate(i), coordinate(j), coordinate(k)});
                points.insert(points.end(), xi.begin(), xi.end());
            }
    return points;
}

} // namespace

void Volume::bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) const {
    for_each_run(first, count, [&](std::size_t element_class, std::uint64_t local, std::uint64_t n_run, std::uint64_t offset) {
        native::RangeBounder bounder(geometry_space(element_class));
        const std::size_t n_modes = native::n_modes(geometry_space(element_class));
        for_each_block(n_run, elements_at_once(3 * n_modes), [&](std::uint64_t done, std::uint64_t n) {
            // A host that asks for bounds evaluates the mapping soon.
            const std::vector<double> coefficients = kept_geometry(element_class, local + done, n);
            for (std::uint64_t element = 0; element < n; ++element) {
                for (std::size_t direction = 0; direction < 3; ++direction) {
                    const native::Range range =
                        bounder(std::span(coefficients).subspan((3 * element + direction) * n_modes, n_modes));
                    if (!std::isfinite(range.lower) || !std::isfinite(range.upper)) {
                        std::int64_t number = 0;
                        element_numbers(m_first_elements[element_class] + local + done + element, std::span(&number, 1));
                        throw error(ELVIS_ERROR_FORMAT,
                                    "the geometry of element " + std::to_string(number) + " holds a number that is not finite");
                    }
                    double* box = bounds.data() + (offset + done + element) * 6;
                    box[direction] = range.lower;
                    box[direction + 3] = range.upper;
                }
            }
        });
    });
}

elvis_certainty Volume::field_ranges(std::size_t field, std::size_t time_step, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) const {
    const std::size_t n_components = description().fields[field].n_components;
    const bool transformed = description().fields[field].transform != native::Transform::none;
    for_each_run(first, count, [&](std::size_t element_class, std::uint64_t local, std::uint64_t n_run, std::uint64_t offset) {
        const native::Space& space = field_space(element_class, field);
        if (transformed) {
            const std::vector<double> points = sample_points(space.shape);
            std::vector<double> values(points.size() / 3 * n_components);
            for (std::uint64_t element = 0; element < n_run; ++element) {
                m_host.check_cancelled();
                evaluate_field(field, time_step, m_first_elements[element_class] + local + element, points, values, {});
                for (std::size_t component = 0; component < n_components; ++component) {
                    double* range = ranges.data() + ((offset + element) * n_components + component) * 2;
                    range[0] = std::numeric_limits<double>::infinity();
                    range[1] = -range[0];
                    for (std::size_t i = component; i < values.size(); i += n_components) {
                        range[0] = std::min(range[0], values[i]);
                        range[1] = std::max(range[1], values[i]);
                    }
                }
            }
            return;
        }
        native::RangeBounder bounder(space);
        const std::size_t n_modes = native::n_modes(space);
        for_each_block(n_run, elements_at_once(n_components * n_modes), [&](std::uint64_t done, std::uint64_t n) {
            const std::vector<double> coefficients = read_field(field, time_step, element_class, local + done, n);
            for (std::uint64_t i = 0; i < n * n_components; ++i) {
                const native::Range range = bounder(std::span(coefficients).subspan(i * n_modes, n_modes));
                double* out = ranges.data() + ((offset + done) * n_components + i) * 2;
                out[0] = range.lower;
                out[1] = range.upper;
            }
        });
    });
    return transformed ? ELVIS_ESTIMATED : ELVIS_CERTIFIED;
}

void Volume::check_jacobians(std::uint64_t first, double tolerance, std::span<native::JacobianCheck> checks) const {
    for_each_run(first, checks.size(),
                 [&](std::size_t element_class, std::uint64_t local, std::uint64_t n_run, std::uint64_t offset) {
                     native::JacobianChecker checker(geometry_space(element_class), {.tolerance = tolerance});
                     const std::size_t numbers = 3 * native::n_modes(geometry_space(element_class));
                     for_each_block(n_run, elements_at_once(numbers), [&](std::uint64_t done, std::uint64_t n) {
                         checker(read_geometry(element_class, local + done, n), checks.subspan(offset + done, n));
                     });
                 });
}

} // namespace elvis::native_plugin
