/**
 * @file device_checks.cpp
 * Checks that the functions of the GLSL snippets are what they say: derivatives, inverses, the same as on the CPU.
 */
#include <core/base/error.hpp>
#include <core/conformance/checks/device_check_tools.hpp>
#include <core/probe/device_evaluator.hpp>
#include <core/shader/compiler.hpp>

namespace elvis::conformance {

namespace {

void check_compilation(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    const Device device(context.subject().device);
    std::size_t n_compiled = 0;
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        if (precision == Precision::float64 && !device.summary().has_float64) {
            continue;
        }
        DeviceVolume on_device(device, volume, precision, nullptr);
        for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
            on_device.select(field, 0, std::vector<double>(volume.fields()[field].n_components, 0.0));
            const auto n_classes = static_cast<std::uint32_t>(std::min<std::size_t>(volume.classes().size(), 12));
            for (std::uint32_t c = 0; c < n_classes; ++c) {
                for (const bool is_twice : {false, true}) {
                    const std::string where = "class " + std::to_string(c) + ", field " + volume.fields()[field].name +
                                              (precision == Precision::float64 ? ", float64" : ", float32") +
                                              (is_twice ? ", twice in one kernel" : "");
                    context.progress("compiling " + where);
                    KernelRequest request;
                    request.name = "conformance";
                    request.kernel = "conformance/conformance.comp";
                    request.precision = precision;
                    // Differences in their place are the host's, and long to compile.
                    constexpr std::uint32_t hessians = ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN;
                    request.with_second_derivatives = (volume.snippet(c).capabilities & hessians) != 0;
                    on_device.add_field(request, c);
                    if (is_twice) {
                        request.instances.push_back(request.instances.front());
                    }
                    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
                    request.push_constant_bytes = sizeof(std::uint32_t);
                    try {
                        if (is_twice) {
                            compile_shader(compose_text(device, request), request.name);
                        } else {
                            const ComposedKernel kernel(device, request);
                        }
                        ++n_compiled;
                    } catch (const Error& error) {
                        context.fail(where + ": " + error.what());
                        return;
                    }
                }
            }
        }
    }
    context.note(std::to_string(n_compiled) + " kernels compiled");
}

/** What to say where the snippet gives world coordinates, although its positions are said to be relative to the origin. */
std::string origin_hint(const Sample& sample, const Point& origin, const Point& position, double tolerance) {
    double shift = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        shift = std::max(shift, std::abs(origin[k]));
        if (!(std::abs(sample.position[k] - position[k]) <= tolerance)) {
            return {};
        }
    }
    return shift > tolerance ? "; the difference is the element's origin: with ELVIS_SNIPPET_LOCAL_ORIGIN, subtract "
                               "elvis_fill_request.origins from positions in fill_buffer"
                             : "";
}

void check_mapping(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.has_evaluation()) {
        throw Skipped("the plugin does not evaluate on the CPU");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    Complaints complaints(context);
    double worst = 0;
    for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
        sampler.select(field, 0);
        const std::uint32_t n_components = volume.fields()[field].n_components;
        const auto points = sample_points(volume, context.subject().seed, n_components, false);
        context.progress("snippet at points of field " + volume.fields()[field].name);
        const auto samples = sampler.sample(points);
        const auto scales = scales_of(points, samples);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const SamplePoint& point = points[i];
            const Scales& scale = scales.at(point.element);
            Point position{};
            std::array<double, 9> jacobian{};
            std::vector<double> values(n_components);
            volume.evaluate_mapping(point.element, point.xi, position, jacobian);
            volume.evaluate_field(field, 0, point.element, point.xi, values, {});
            const Point origin = sampler.origin(point.element);
            for (std::size_t k = 0; k < 3; ++k) {
                const double error = std::abs(samples[i].position[k] + origin[k] - position[k]);
                const double size = scale.position + std::abs(origin[k]);
                worst = std::max(worst, size > 0 ? error / size : 0.0);
                if (!(error <= 1e-10 * size)) {
                    complaints.add(place(volume, point) + ": elvis_mapping gives coordinate " + std::to_string(k) + " as " +
                                   text_of(samples[i].position[k] + origin[k]) + ", evaluate_mapping " + text_of(position[k]) +
                                   origin_hint(samples[i], origin, position, 1e-10 * size));
                }
            }
            const double error = std::abs(samples[i].value - values[point.component]);
            worst = std::max(worst, scale.value > 0 ? error / scale.value : 0.0);
            if (!(error <= 1e-10 * scale.value) && !(std::isnan(samples[i].value) && std::isnan(values[point.component]))) {
                complaints.add(place(volume, point) + ": elvis_field_value of " + volume.fields()[field].name + " is " +
                               text_of(samples[i].value) + ", evaluate_field says " + text_of(values[point.component]));
            }
        }
    }
    context.note("largest relative difference " + short_text(worst));
}

void check_jacobian(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    Complaints complaints(context);
    const auto points = sample_points(volume, context.subject().seed, 1, true);
    context.progress("snippet at points");
    const auto samples = sampler.sample(points);
    const auto scales = scales_of(points, samples);
    double worst = 0;
    for (std::size_t j = 0; j < volume.dimension(); ++j) {
        const auto expected = differences_of(sampler, points, j, [](const Sample& sample) {
            return std::vector(sample.position.begin(), sample.position.end());
        });
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Scales& scale = scales.at(points[i].element);
            const double tolerance = 1e-7 * scale.jacobian + 1e-12 * scale.position;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::string entry = "dx_" + std::to_string(k) + "/dxi_" + std::to_string(j);
                const double given = samples[i].jacobian[3 * j + k];
                worst = std::max(worst, scale.jacobian > 0 ? std::abs(given - expected[i][k]) / scale.jacobian : 0.0);
                if (!(std::abs(given - expected[i][k]) <= tolerance)) {
                    complaints.add(place(volume, points[i]) + ": elvis_jacobian gives " + entry + " = " + text_of(given) +
                                   ", differences of elvis_mapping say " + text_of(expected[i][k]) + " (column j is dx/dxi_j)");
                }
                const double pair = samples[i].pair_jacobian[3 * j + k];
                if (!(std::abs(pair - given) <= 1e-10 * scale.jacobian)) {
                    complaints.add(place(volume, points[i]) + ": elvis_mapping_jacobian gives " + entry + " = " +
                                   text_of(pair) + ", elvis_jacobian " + text_of(given));
                }
            }
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!(std::abs(samples[i].pair_position[k] - samples[i].position[k]) <=
                  1e-12 * scales.at(points[i].element).position)) {
                complaints.add(place(volume, points[i]) +
                               ": elvis_mapping_jacobian and elvis_mapping give different positions");
            }
        }
    }
    context.note("largest difference " + short_text(worst) + " of the largest entry");
}

void check_gradient(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    Complaints complaints(context);
    double worst = 0;
    for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
        sampler.select(field, 0);
        const std::string& name = volume.fields()[field].name;
        const auto points = sample_points(volume, context.subject().seed, volume.fields()[field].n_components, true);
        context.progress("gradients of " + name);
        const auto samples = sampler.sample(points);
        const auto scales = scales_of(points, samples);
        for (std::size_t j = 0; j < volume.dimension(); ++j) {
            const auto expected =
                differences_of(sampler, points, j, [](const Sample& sample) { return std::vector{sample.value}; });
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Scales& scale = scales.at(points[i].element);
                const double error = std::abs(samples[i].gradient[j] - expected[i][0]);
                worst = std::max(worst, scale.gradient > 0 ? error / scale.gradient : 0.0);
                if (!(error <= 1e-7 * scale.gradient + 1e-10 * scale.value)) {
                    complaints.add(place(volume, points[i]) + ": elvis_field_gradient of " + name + " by xi_" +
                                   std::to_string(j) + " is " + text_of(samples[i].gradient[j]) +
                                   ", differences of elvis_field_value say " + text_of(expected[i][0]));
                }
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!(std::abs(samples[i].gradient_value - samples[i].value) <= 1e-11 * scales.at(points[i].element).value)) {
                complaints.add(place(volume, points[i]) + ": elvis_field_gradient gives the value " +
                               text_of(samples[i].gradient_value) + ", elvis_field_value " + text_of(samples[i].value));
            }
        }
    }
    context.note("largest difference " + short_text(worst) + " of the largest derivative");
}

void check_hessians(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if ((capabilities_of(volume) & (ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN)) == 0) {
        throw Skipped("the snippets give no second derivatives");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    Complaints complaints(context);
    SampleOptions options;
    options.with_hessians = true;
    for (std::uint32_t field = 0; field < n_checked_fields(volume); ++field) {
        sampler.select(field, 0);
        const auto points = sample_points(volume, context.subject().seed, volume.fields()[field].n_components, true);
        context.progress("second derivatives of " + volume.fields()[field].name);
        const auto samples = sampler.sample(points, options);
        const auto scales = scales_of(points, samples);
        for (std::size_t j = 0; j < volume.dimension(); ++j) {
            // Rows: gradient (3), Jacobian (9), and what they are beside.
            const auto expected = differences_of(sampler, points, j, [](const Sample& sample) {
                std::vector<double> row(sample.gradient.begin(), sample.gradient.end());
                row.insert(row.end(), sample.jacobian.begin(), sample.jacobian.end());
                return row;
            });
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Scales& scale = scales.at(points[i].element);
                const std::uint32_t capabilities = volume.snippet(class_of(volume, points[i].element)).capabilities;
                for (std::size_t l = 0; l < volume.dimension(); ++l) {
                    const std::string entry = "[" + std::to_string(j) + "][" + std::to_string(l) + "]";
                    const double bend = samples[i].hessian[3 * j + l];
                    if ((capabilities & ELVIS_SNIPPET_FIELD_HESSIAN) != 0 &&
                        !(std::abs(bend - expected[i][l]) <= 1e-6 * (scale.gradient + std::abs(bend)) + 1e-9 * scale.value)) {
                        complaints.add(place(volume, points[i]) + ": elvis_field_hessian gives hessian" + entry + " = " +
                                       text_of(bend) + ", differences of the gradient say " + text_of(expected[i][l]));
                    }
                    for (std::size_t k = 0; k < 3 && (capabilities & ELVIS_SNIPPET_MAPPING_HESSIAN) != 0; ++k) {
                        const double given = samples[i].mapping_hessians[k][3 * j + l];
                        const double wanted = expected[i][3 + 3 * l + k];
                        if (!(std::abs(given - wanted) <= 1e-6 * (scale.jacobian + std::abs(given)))) {
                            constexpr const char* names[] = {"hessian_x", "hessian_y", "hessian_z"};
                            complaints.add(place(volume, points[i]) + ": elvis_mapping_hessian gives " + names[k] + entry +
                                           " = " + text_of(given) + ", differences of the Jacobian say " + text_of(wanted));
                        }
                    }
                }
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Scales& scale = scales.at(points[i].element);
            double error = std::abs(samples[i].hessian_value - samples[i].value) / std::max(scale.value, 1e-300);
            for (std::size_t k = 0; k < volume.dimension(); ++k) {
                error = std::max(error, std::abs(samples[i].hessian_gradient[k] - samples[i].gradient[k]) /
                                            std::max(scale.gradient, 1e-300) * 1e-3);
            }
            if (!(error <= 1e-9)) {
                complaints.add(place(volume, points[i]) +
                               ": elvis_field_hessian gives another value or gradient than the other functions");
            }
        }
    }
}

void check_inverse(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if ((capabilities_of(volume) & ELVIS_SNIPPET_INVERSE_MAPPING) == 0) {
        throw Skipped("the snippets give no inverse mapping");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    Complaints complaints(context);
    const auto points = sample_points(volume, context.subject().seed, 1, true);
    context.progress("inverse mapping at points");
    const auto samples = sampler.sample(points);
    std::vector<SamplePoint> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        found.push_back({points[i].element, samples[i].inverse, 0});
    }
    const auto back = sampler.sample(found);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if ((volume.snippet(class_of(volume, points[i].element)).capabilities & ELVIS_SNIPPET_INVERSE_MAPPING) == 0) {
            continue;
        }
        double size = 0;
        double error = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < volume.dimension(); ++j) {
                size = std::max(size, std::abs(samples[i].jacobian[3 * j + k]));
            }
            error = std::max(error, std::abs(back[i].position[k] - samples[i].position[k]));
        }
        if (samples[i].inverse_found == 0) {
            complaints.add(place(volume, points[i]) +
                           ": elvis_inverse_mapping finds no reference point for the position there");
        } else if (!(error <= 1e-7 * size)) {
            complaints.add(place(volume, points[i]) + ": elvis_inverse_mapping gives xi " + text_of(samples[i].inverse) +
                           ", whose position is " + short_text(error) + " away");
        }
    }
}

/** Whether the determinant has one sign over the sampled points, so that the mapping can be inverted. */
bool is_regular(const std::vector<Sample>& samples, std::size_t first, std::size_t count) {
    bool has_positive = false;
    bool has_negative = false;
    for (std::size_t i = first; i < first + count; ++i) {
        const Matrix& j = samples[i].jacobian;
        const double determinant =
            j[0] * (j[4] * j[8] - j[5] * j[7]) - j[3] * (j[1] * j[8] - j[2] * j[7]) + j[6] * (j[1] * j[5] - j[2] * j[4]);
        has_positive = has_positive || determinant > 0;
        has_negative = has_negative || determinant < 0;
    }
    return has_positive != has_negative;
}

void check_inside(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (volume.dimension() != 3) {
        throw Skipped("only for volumes of dimension 3");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    const auto points = sample_points(volume, context.subject().seed, 1, true);
    context.progress("positions of points");
    const auto samples = sampler.sample(points);
    DeviceEvaluator evaluator(volume, context.subject().device);
    std::vector<InversionQuery> queries;
    std::vector<std::size_t> asked;
    for (std::size_t first = 0; first < points.size(); first += n_points) {
        if (!is_regular(samples, first, n_points)) {
            continue;
        }
        const Point origin = sampler.origin(points[first].element);
        std::array<double, 6> box{};
        volume.bounds(points[first].element, 1, box);
        for (std::size_t i = first; i < first + n_points; ++i) {
            // Beside the element's own boundary, if it has one, rounding decides.
            const double near = 1e-9 * (std::abs(samples[i].inside) + samples[i].inside_bounds[0]);
            if (std::abs(samples[i].inside) < near) {
                continue;
            }
            const Point& x = samples[i].position;
            queries.push_back({points[i].element, {x[0] + origin[0], x[1] + origin[1], x[2] + origin[2]}});
            asked.push_back(i);
        }
        // And one that lies outside: the bounds' corner, pushed out by their diagonal.
        queries.push_back({points[first].element, {2 * box[3] - box[0], 2 * box[4] - box[1], 2 * box[5] - box[2]}});
        asked.push_back(points.size());
    }
    if (queries.empty()) {
        throw Skipped("the Jacobian determinant changes its sign in every element");
    }
    context.progress("inverting the mapping");
    const std::vector<Inversion> found = evaluator.invert(std::span<const InversionQuery>(queries));
    Complaints complaints(context);
    for (std::size_t n = 0; n < queries.size(); ++n) {
        if (asked[n] == points.size()) {
            if (found[n].outcome == Inversion::Outcome::inside) {
                complaints.add("element " + std::to_string(queries[n].element) +
                               " is said to contain a position far outside its bounds");
            }
        } else if (samples[asked[n]].inside > 0) {
            if (found[n].outcome == Inversion::Outcome::inside) {
                complaints.add(place(volume, points[asked[n]]) +
                               ": elvis_inside is positive, but the point is said to lie inside");
            }
        } else if (found[n].outcome != Inversion::Outcome::inside) {
            complaints.add(place(volume, points[asked[n]]) +
                           ": Newton's method does not find this point from its position; do mapping and "
                           "Jacobian agree?");
        }
    }
    context.note(std::to_string(queries.size()) + " positions");
}

} // namespace

std::vector<Check> device_checks() {
    return {
        {"snippet-compiles", "every class's snippet compiles in both precisions, also twice in one kernel", check_compilation},
        {"snippet-values", "mapping and field of the snippet are those of the plugin's functions for the CPU", check_mapping},
        {"snippet-jacobian", "elvis_jacobian is the derivative of elvis_mapping, and elvis_mapping_jacobian agrees",
         check_jacobian},
        {"snippet-gradient", "elvis_field_gradient is the derivative of elvis_field_value", check_gradient},
        {"snippet-hessians", "second derivatives of field and mapping are those of gradient and Jacobian", check_hessians},
        {"snippet-inverse", "elvis_inverse_mapping inverts elvis_mapping", check_inverse},
        {"snippet-inside",
         "positions in an element are found in it by Newton's method, and positions outside, or beyond elvis_inside, are not",
         check_inside},
    };
}

} // namespace elvis::conformance
