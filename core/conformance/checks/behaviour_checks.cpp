/**
 * @file behaviour_checks.cpp
 * Checks of how GLSL snippets behave: in single precision, outside the element, at NaN; whether they end, write their outputs
 * and stay within their arrays.
 */
#include <core/base/error.hpp>
#include <core/base/infinity.hpp>
#include <core/conformance/checks/device_check_tools.hpp>
#include <core/plugin_host/selected_volume.hpp>
#include <core/shader/poison.hpp>

#include <elvis/demand.h>

#include <cstddef>
#include <cstring>
#include <limits>

namespace elvis::conformance {

namespace {

void check_precision(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler exact(volume, context.subject().device, Precision::float64);
    DeviceSampler single(volume, context.subject().device, Precision::float32);
    Complaints complaints(context);
    constexpr double unit = 0x1p-24;
    double worst_value = 0;
    double worst_position = 0;
    for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
        exact.select(field, 0);
        single.select(field, 0);
        auto points = sample_points(volume, context.subject().seed, volume.fields()[field].n_components, true);
        for (SamplePoint& point : points) {
            for (double& coordinate : point.xi) {
                coordinate = static_cast<double>(static_cast<float>(coordinate)); // the same point in both
            }
        }
        context.progress("both precisions of field " + volume.fields()[field].name);
        const auto expected = exact.sample(points);
        const auto found = single.sample(points);
        const auto scales = scales_of(points, expected);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Scales& scale = scales.at(points[i].element);
            // A thousand roundings of what is summed up: an order of 14 has some hundred terms of alternating sign.
            const double value_error = std::abs(found[i].value - expected[i].value);
            worst_value = std::max(worst_value, scale.value > 0 ? value_error / scale.value : 0.0);
            if (!(value_error <= 1000 * unit * (scale.value + scale.gradient)) && std::isfinite(expected[i].value)) {
                complaints.add(place(volume, points[i]) + ": elvis_field_value of " + volume.fields()[field].name + " is " +
                               text_of(found[i].value) + " in float32 and " + text_of(expected[i].value) + " in float64");
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const double error = std::abs(found[i].position[k] - expected[i].position[k]);
                worst_position = std::max(worst_position, scale.position > 0 ? error / scale.position : 0.0);
                if (!(error <= 1000 * unit * (scale.position + scale.jacobian))) {
                    complaints.add(place(volume, points[i]) + ": elvis_mapping gives coordinate " + std::to_string(k) + " as " +
                                   text_of(found[i].position[k]) + " in float32 and " + text_of(expected[i].position[k]) +
                                   " in float64");
                }
            }
        }
    }
    context.note("largest error in float32: value " + short_text(worst_value) + ", position " + short_text(worst_position));
}

void check_outside(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    Complaints complaints(context);
    auto inside = sample_points(volume, context.subject().seed, 1, false);
    // From the centroid through each point: a little inside, a little outside, and clearly outside.
    std::vector<SamplePoint> near;
    std::vector<SamplePoint> beyond;
    std::vector<SamplePoint> far;
    const auto moved = [](const SamplePoint& point, double factor) {
        SamplePoint to = point;
        constexpr Point centre{-0.25, -0.25, -0.25};
        for (std::size_t k = 0; k < 3; ++k) {
            to.xi[k] = centre[k] + factor * (point.xi[k] - centre[k]);
        }
        return to;
    };
    for (const SamplePoint& point : inside) {
        near.push_back(moved(point, 1 - 1e-7));
        beyond.push_back(moved(point, 1 + 1e-7));
        far.push_back(moved(point, 1.25));
    }
    context.progress("points near faces");
    const auto on = sampler.sample(inside);
    const auto scales = scales_of(inside, on);
    const auto before = sampler.sample(near);
    const auto after = sampler.sample(beyond);
    context.progress("points clearly outside");
    const auto outside = sampler.sample(far);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const Scales& scale = scales.at(inside[i].element);
        double jump = std::abs(after[i].value - before[i].value) / (scale.value + scale.gradient + 1e-300);
        for (std::size_t k = 0; k < 3; ++k) {
            jump = std::max(jump, std::abs(after[i].position[k] - before[i].position[k]) / (scale.jacobian + 1e-300));
        }
        if (!(jump <= 1e-4)) {
            complaints.add(place(volume, inside[i]) +
                           ": mapping or field jump where the reference shape ends; outside, return the natural "
                           "extension");
        }
        const bool is_finite = std::isfinite(outside[i].position[0] + outside[i].position[1] + outside[i].position[2]) &&
                               (std::isfinite(outside[i].value) || !std::isfinite(on[i].value)) &&
                               std::isfinite(outside[i].inside);
        if (!is_finite) {
            complaints.add(place(volume, far[i]) +
                           ", outside the shape: mapping, field or elvis_inside are not finite; return the natural extension");
        }
    }
}

std::vector<SamplePoint> hostile_points(const RuntimeVolume& volume, std::uint64_t seed) {
    const double nan = std::nan("");
    std::vector<SamplePoint> points;
    for (const std::uint64_t element : some_elements(volume, 2, seed)) {
        for (const Point& xi :
             {Point{nan, nan, nan}, Point{nan, 0, 0}, Point{0, nan, 0}, Point{0, 0, nan}, Point{infinity, 0, 0},
              Point{0, -infinity, 0}, Point{0, 0, infinity}, Point{1e30, -1e30, 1e30}, Point{1e6, 1e6, 1e6}}) {
            points.push_back({element, xi, 0});
        }
    }
    return points;
}

void check_hostile_points(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float32);
    sampler.select(0, 0);
    const std::vector<SamplePoint> points = hostile_points(volume, context.subject().seed);
    // First with loops that are counted and left, so that no device hangs; then as it is.
    context.progress("the snippet at NaN, infinite and huge xi, with counted loops");
    SampleOptions options;
    options.is_debug_build = true;
    const auto samples = sampler.sample(points, options);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (samples[i].is_endless != 0) {
            context.fail(place(volume, points[i]) +
                         ": a loop of the snippet takes more than 50000 iterations; bound it by a constant");
            return;
        }
    }
    context.progress("the snippet at NaN, infinite and huge xi (does a loop depend on xi?)");
    sampler.sample(points);
}

void check_outputs(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    const auto points = sample_points(volume, context.subject().seed, volume.fields()[0].n_components, true);
    SampleOptions options;
    options.with_hessians = (capabilities_of(volume) & (ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN)) != 0;
    options.is_debug_build = true;
    context.progress("functions whose outputs begin as nonsense");
    const auto samples = sampler.sample(points, options);
    Complaints complaints(context);
    const auto is_poisoned = [](const double* first, std::size_t count) {
        return std::any_of(first, first + count, [](double number) { return std::abs(number) >= 0.25 * poison; });
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Sample& s = samples[i];
        const auto complain = [&](const char* function, const char* output) {
            complaints.add(place(volume, points[i]) + ": " + function + " does not write its output " + output);
        };
        const std::uint32_t has = volume.snippet(class_of(volume, points[i].element)).capabilities;
        if ((has & ELVIS_SNIPPET_FIELD_GRADIENT) != 0 && is_poisoned(&s.gradient_value, 1)) {
            complain("elvis_field_gradient", "value");
        }
        if ((has & ELVIS_SNIPPET_FIELD_GRADIENT) != 0 && is_poisoned(s.gradient.data(), 3)) {
            complain("elvis_field_gradient", "gradient");
        }
        if ((has & ELVIS_SNIPPET_MAPPING_JACOBIAN) != 0 &&
            (is_poisoned(s.pair_position.data(), 3) || is_poisoned(s.pair_jacobian.data(), 9))) {
            complain("elvis_mapping_jacobian", "x or jacobian");
        }
        if ((has & ELVIS_SNIPPET_INVERSE_MAPPING) != 0 && s.inverse_found != 0 && is_poisoned(s.inverse.data(), 3)) {
            complain("elvis_inverse_mapping", "xi");
        }
        if ((has & ELVIS_SNIPPET_INSIDE) != 0 && (is_poisoned(&s.inside, 1) || is_poisoned(s.inside_gradient.data(), 3))) {
            complain("elvis_inside", "g or gradient");
        }
        if ((has & ELVIS_SNIPPET_FIELD_HESSIAN) != 0 && is_poisoned(&s.hessian_value, 13)) {
            complain("elvis_field_hessian", "value, gradient or hessian");
        }
        if ((has & ELVIS_SNIPPET_MAPPING_HESSIAN) != 0 && is_poisoned(s.hessian_position.data(), 39)) {
            complain("elvis_mapping_hessian", "x, jacobian or hessians");
        }
    }
}

void check_indices(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    auto points = sample_points(volume, context.subject().seed, volume.fields()[0].n_components, true);
    // Newton's iterations and rays go outside; a point on a face may be off it by rounding.
    for (std::size_t i = points.size(); i-- > 0;) {
        SamplePoint outside = points[i];
        for (double& coordinate : outside.xi) {
            coordinate *= 1.5;
        }
        points.push_back(outside);
    }
    const std::vector<SamplePoint> hostile = hostile_points(volume, context.subject().seed);
    points.insert(points.end(), hostile.begin(), hostile.end());
    SampleOptions options;
    options.is_debug_build = true;
    context.progress("indices of arrays and records");
    const auto samples = sampler.sample(points, options);
    Complaints complaints(context);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (samples[i].bad_index_line != 0) {
            complaints.add(place(volume, points[i]) + ": " + text_of_bad_index(samples[i]));
        }
    }
}

void check_field_offset(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if ((capabilities_of(volume) & ELVIS_SNIPPET_FIELD_OFFSET) == 0) {
        throw Skipped("the snippets take no field offset");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    Complaints complaints(context);
    constexpr double offset = 3.25;
    for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
        const auto points = sample_points(volume, context.subject().seed, volume.fields()[field].n_components, true);
        sampler.select(field, 0);
        const auto plain = sampler.sample(points);
        sampler.select(field, 0, offset);
        context.progress("field " + volume.fields()[field].name + " less an offset");
        const auto less = sampler.sample(points);
        const auto scales = scales_of(points, plain);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double wanted = plain[i].value - sampler.field_offset(points[i].component);
            const Scales& scale = scales.at(points[i].element);
            if (!(std::abs(less[i].value - wanted) <= 1e-10 * (scale.value + offset))) {
                complaints.add(place(volume, points[i]) + ": with an offset of " + text_of(offset) + " the field is " +
                               text_of(less[i].value) + " instead of " + text_of(wanted) + " (ELVIS_SNIPPET_FIELD_OFFSET)");
            }
        }
    }
}

/** Points of every other element that is looked at, so that numbers change. */
std::vector<SamplePoint> half_of(const std::vector<SamplePoint>& points) {
    std::vector<SamplePoint> half;
    bool is_left_out = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        is_left_out = i == 0 || points[i].element != points[i - 1].element ? !is_left_out : is_left_out;
        if (!is_left_out) {
            half.push_back(points[i]);
        }
    }
    return half;
}

/** Whether all is alike that snippets have to give, to the bit. */
bool are_alike(const Sample& one, const Sample& other) {
    const auto* const a = reinterpret_cast<const std::byte*>(&one);
    const auto* const b = reinterpret_cast<const std::byte*>(&other);
    constexpr std::size_t end = offsetof(Sample, inverse_found), inside = offsetof(Sample, inside);
    return std::memcmp(a, b, end) == 0 && std::memcmp(a + inside, b + inside, sizeof(Sample) - inside) == 0;
}

void check_element_records(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if ((capabilities_of(volume) & ELVIS_SNIPPET_ELEMENT_RECORDS) == 0) {
        throw Skipped("the snippets do not say that records belong to elements");
    }
    if (!can_select(volume)) {
        context.fail("some classes say that records belong to elements (ELVIS_SNIPPET_ELEMENT_RECORDS), and some do not");
        return;
    }
    const auto points = half_of(sample_points(volume, context.subject().seed, 1, false));
    if (points.empty()) {
        throw Skipped("there is one element, which cannot be left out");
    }
    std::vector<std::uint64_t> elements;
    for (const SamplePoint& point : points) {
        elements.push_back(point.element);
    }
    std::ranges::sort(elements);
    const auto repeated = std::ranges::unique(elements);
    elements.erase(repeated.begin(), repeated.end());
    auto renumbered = points;
    for (SamplePoint& point : renumbered) {
        point.element = static_cast<std::uint64_t>(std::ranges::lower_bound(elements, point.element) - elements.begin());
    }
    const RuntimeVolume selected = selected_volume(volume, elements, SelectedFaces::none);
    DeviceSampler whole(volume, context.subject().device, Precision::float64);
    DeviceSampler some(selected, context.subject().device, Precision::float64);
    whole.select(0, 0);
    some.select(0, 0);
    context.progress("some elements alone");
    const auto expected = whole.sample(points), given = some.sample(renumbered);
    Complaints complaints(context);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!are_alike(given[i], expected[i])) {
            complaints.add(place(volume, points[i]) + ": where other elements are left out the snippet gives something else, " +
                           text_of(given[i].value) + " instead of " + text_of(expected[i].value) +
                           " (ELVIS_SNIPPET_ELEMENT_RECORDS)");
        }
    }
}

} // namespace

std::vector<Check> behaviour_checks() {
    return {
        {"snippet-precision", "float32 and float64 agree as far as float32 can", check_precision},
        {"snippet-outside", "outside the reference shape the snippet gives the natural extension", check_outside},
        {"snippet-hostile", "the snippet comes to an end at NaN, infinite and huge reference points", check_hostile_points},
        {"snippet-outputs", "functions write all of their outputs", check_outputs},
        {"snippet-indices", "indices of arrays, vectors and records are in range, outside the shape and at NaN, too",
         check_indices},
        {"element-records", "with the capability ELEMENT_RECORDS elements can be left out", check_element_records},
        {"snippet-offset", "with the capability FIELD_OFFSET the field lacks the offset", check_field_offset},
    };
}

} // namespace elvis::conformance
