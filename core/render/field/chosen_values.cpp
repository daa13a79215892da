#include <core/render/field/chosen_values.hpp>

#include <core/expression/expression.hpp>
#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

/** Of all elements together, about, where there are not more elements. */
constexpr double n_chosen_samples = 5000;
/** Of a value found by place, relative to the field's largest: of mappings inverted to about 1e-15, and of the basis. */
constexpr double relative_rounding = 1e-14;

/** Points of a shape on a lattice of n points a direction, corners and faces included. */
std::vector<Vector3> lattice_in(elvis_shape shape, std::uint32_t dimension, int n) {
    std::vector<Vector3> points;
    const auto at = [&](int i) { return 2.0 * i / (n - 1) - 1; };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < (dimension == 3 ? n : 1); ++k) {
                const Vector3 xi{at(i), at(j), dimension == 3 ? at(k) : 0};
                if (reference_excess(shape, xi) <= 0) {
                    points.push_back(xi);
                }
            }
        }
    }
    return points;
}

std::vector<ReferencePoint> sample_places(const RuntimeVolume& volume) {
    const double for_each = n_chosen_samples / static_cast<double>(std::max<std::uint64_t>(1, volume.n_elements()));
    const int n = std::clamp(static_cast<int>(std::lround(std::pow(for_each, 1.0 / volume.dimension()))), 2, 7);
    std::vector<ReferencePoint> places;
    for (const ClassInfo& info : volume.classes()) {
        const std::vector<Vector3> lattice = lattice_in(info.shape, volume.dimension(), n);
        for (std::uint64_t element = 0; element < info.n_elements; ++element) {
            for (const Vector3& xi : lattice) {
                places.push_back({info.first_element + element, xi});
            }
        }
    }
    return places;
}

} // namespace

std::vector<double> chosen_values(CpuEvaluator& evaluator, const FieldChoice& field, std::uint32_t time_step,
                                  std::span<const ReferencePoint> places) {
    std::vector<double> values;
    values.reserve(places.size());
    if (field.expression) {
        for (const ExpressionSample& sample : evaluator.evaluate(field.expression, time_step, places, false)) {
            values.push_back(sample.value);
        }
        return values;
    }
    for (const FieldSample& sample : evaluator.evaluate(field.field, time_step, places, false)) {
        double square = 0;
        for (const double component : sample.values) {
            square += component * component;
        }
        values.push_back(field.component < 0 ? std::sqrt(square) : sample.values[static_cast<std::size_t>(field.component)]);
    }
    return values;
}

bool is_by_place(const FieldChoice& field, const RuntimeVolume& volume) {
    if (field.is_own_boundary) {
        return false;
    }
    const auto found = [&](std::uint32_t index) { return volume.fields()[index].is_by_place; };
    return field.expression ? std::ranges::any_of(field.expression->fields(), found) : found(field.field);
}

FieldExtrema extrema_by_place(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<ReferencePoint> places = sample_places(volume);
    CpuEvaluator evaluator(volume);
    const std::vector<double> values = chosen_values(evaluator, field, time_step, places);
    FieldExtrema extrema;
    extrema.minimum.value = infinity;
    extrema.maximum.value = -infinity;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            continue;
        }
        const FieldExtremum here{values[i], values[i], places[i].element, places[i].xi};
        extrema.minimum = here.value < extrema.minimum.value ? here : extrema.minimum;
        extrema.maximum = here.value > extrema.maximum.value ? here : extrema.maximum;
    }
    extrema.certainty = ELVIS_ESTIMATED;
    return extrema;
}

double rounding_by_place(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step) {
    double largest = 0;
    const std::vector<std::uint32_t> fields = field.expression ? field.expression->fields() : std::vector{field.field};
    for (const std::uint32_t index : fields) {
        FieldChoice magnitude;
        magnitude.field = index;
        magnitude.component = volume.fields()[index].n_components > 1 ? -1 : 0;
        const FieldExtrema extrema = extrema_by_place(volume, magnitude, time_step);
        largest = std::max({largest, std::abs(extrema.minimum.value), std::abs(extrema.maximum.value)});
    }
    return std::isfinite(largest) ? relative_rounding * largest : 0;
}

} // namespace elvis
