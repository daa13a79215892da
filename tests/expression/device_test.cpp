// Expressions on the device against those on the CPU, on curved elements of all shapes; their models against samples.
#include <tests/native_plugin/volume_fixture.hpp>

#include <core/expression/glsl.hpp>
#include <core/expression/volume_point.hpp>
#include <core/volume/device_volume.hpp>
#include <tests/support/device.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

constexpr std::uint32_t n_points = 64;
constexpr std::uint32_t n_elements = 3;
constexpr std::size_t point_numbers = 3, patch_numbers = 14;

constexpr const char* gradient_kernel = R"(
layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) readonly buffer core_points_block { elvis_real core_given[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { elvis_real core_results[]; };
void main() {
    const uint i = gl_GlobalInvocationID.x;
    const elvis_vec3 xi = elvis_vec3(core_given[3u * i], core_given[3u * i + 1u], core_given[3u * i + 2u]);
    elvis_real value;
    elvis_vec3 gradient;
    core_shown_gradient(i % 3u, xi, value, gradient);
    core_results[5u * i] = core_shown_value(i % 3u, xi);
    core_results[5u * i + 1u] = value;
    core_results[5u * i + 2u] = gradient.x;
    core_results[5u * i + 3u] = gradient.y;
    core_results[5u * i + 4u] = gradient.z;
}
)";

constexpr const char* model_kernel = R"(
layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) readonly buffer core_points_block { elvis_real core_given[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { elvis_real core_results[]; };
elvis_vec3 three(uint at) { return elvis_vec3(core_given[at], core_given[at + 1u], core_given[at + 2u]); }
void main() {
    const uint i = gl_GlobalInvocationID.x, at = 17u * i;
    const core_region region = core_region(three(at + 3u), three(at + 6u), three(at + 9u), three(at + 12u), core_given[at + 15u],
                                       core_given[at + 16u]);
    elvis_real value;
    const core_model model = core_shown_model(i % 3u, three(at), region, value);
    core_results[7u * i] = value;
    core_results[7u * i + 1u] = model.value;
    core_results[7u * i + 2u] = model.slope.x;
    core_results[7u * i + 3u] = model.slope.y;
    core_results[7u * i + 4u] = model.slope.z;
    core_results[7u * i + 5u] = model.remainder;
    core_results[7u * i + 6u] = core_is_model_estimated(i % 3u) ? elvis_real(1) : elvis_real(0);
}
)";

template <class Real>
std::vector<Real> run(KernelRequest request, const char* kernel, const std::vector<double>& given, std::size_t n_results) {
    request.name = kernel == model_kernel ? "model" : "gradient";
    request.kernel = request.name;
    request.kernel_text = kernel;
    request.defines = {{"CORE_FLAG_ESTIMATED", "2048u"}};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    const ComposedKernel composed(test::validated_device(), request);
    const Buffer input(test::validated_device(), given.size() * sizeof(Real)),
        output(test::validated_device(), n_points * n_results * sizeof(Real));
    input.write_items<Real>(std::vector<Real>(given.begin(), given.end()));
    const Buffer* const bindings[]{&input, &output};
    composed.dispatch(bindings, {}, n_points / 32);
    return output.read_items<Real>(n_points * n_results);
}

/** Hexahedra, prisms, pyramids, tetrahedra, curved, with a scalar p of order 4 and a vector u of order 3. */
const TestVolume& curved_volume() {
    static const TestVolume only(
        [] {
            std::vector<ClassPlan> classes;
            for (const native::Shape shape :
                 {native::Shape::hexahedron, native::Shape::prism, native::Shape::pyramid, native::Shape::tetrahedron}) {
                const auto space = [&](std::uint32_t order) {
                    return native::Space{shape, native::Basis::modified, {order, order, order}};
                };
                classes.push_back({space(2), {space(4), space(3)}, n_elements});
            }
            return classes;
        }(),
        {{"p", "", 1, native::Continuity::discontinuous, {}, std::nan("")},
         {"u", "", 3, native::Continuity::discontinuous, {}, std::nan("")}});
    return only;
}

std::vector<double> rounded(std::vector<double> numbers) {
    for (double& number : numbers) {
        number = static_cast<double>(static_cast<float>(number));
    }
    return numbers;
}

/** Points, in single precision exact; below the apex of pyramids, where second derivatives grow. */
std::vector<double> points_of(native::Shape shape, test::Random& random) {
    std::vector<double> points;
    while (points.size() < 3 * n_points) {
        const native::Point xi = random.point(shape);
        if (shape != native::Shape::pyramid || xi[2] < 0.5) {
            points.insert(points.end(), xi.begin(), xi.end());
        }
    }
    return rounded(points);
}

/** Largest errors of value and gradient, relative to the largest of each. */
template <class Real>
std::array<double, 2> errors(const RuntimeVolume& volume, DeviceVolume& data,
                             const std::shared_ptr<const Expression>& expression, std::uint32_t element_class) {
    const ExpressionClass info = expression_class(volume, element_class);
    data.select(selection_of(expression, volume, 0));
    KernelRequest request;
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.buffers = data.host_buffers(element_class);
    data.add_field(request, element_class);
    request.text += gradient_glsl(*expression, info);
    request.with_second_derivatives = true;
    test::Random random(5);
    const std::vector<double> points = points_of(curved_volume().description().classes[element_class].geometry.shape, random);
    const std::vector<Real> results = run<Real>(request, gradient_kernel, points, 5);
    double value_error = 0, value_size = 0, gradient_error = 0, gradient_size = 0;
    for (std::size_t i = 0; i < n_points; ++i) {
        const auto at = [&](const std::array<double, 3>& xi) {
            return VolumePoint(volume, curved_volume().first_element(element_class) + i % 3, xi, 0);
        };
        const std::array<double, 3> xi{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
        VolumePoint point = at(xi);
        const double value = evaluate(*expression, point);
        value_size = std::max(value_size, std::abs(value));
        for (std::size_t k = 0; k < 2; ++k) {
            const double error = std::abs(static_cast<double>(results[5 * i + k]) - value);
            value_error = error <= value_error ? value_error : error;
        }
        if (expression->gradient()) {
            const ValueAndGradient exact = evaluate_gradient(*expression, point);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                gradient_size = std::max(gradient_size, std::abs(exact.gradient[axis]));
                const double error = std::abs(static_cast<double>(results[5 * i + 2 + axis]) - exact.gradient[axis]);
                gradient_error = error <= gradient_error ? gradient_error : error;
            }
        }
    }
    return {value_error / value_size, gradient_size > 0 ? gradient_error / gradient_size : 0};
}

// In double precision in every shape from one text on, before it, and in single precision, in one of the four.
void check_expressions(std::size_t first_in_every_shape) {
    const RuntimeVolume volume = curved_volume().open();
    const char* const texts[] = {
        "(9 + p) * u[0] - x / (9 + y) + p^3 + (9 + p)^0.7 + sqrt(9 + p) + abs(p) + min(p, u[1]) + max(x, z) + p^-2 * 0",
        "sin(p) + cos(x * p) + tan(x / 4) + asin(x / 5) + acos(y / 4) + atan(p) + atan2(u[0], 9 + p) + exp(-p) + log(9 + p) + "
        "pow(9 + p, u[1] / 4)",
        // From here on with derivatives.
        "norm(u) + dot(u, cross(grad(p), u)) + (p > 0 ? sin(p) : cos(p)) + order(u) * 0.1 + element * 0.01 + (x < 0 && y < 0)",
        "q_criterion(u) + div(u) * norm(curl(u) + u)",
        "laplacian(p) + jacobian + scaled_jacobian",
        "d(jacobian, y)",
    };
    double worst[2][2] = {};
    for (std::size_t index = 0; index < std::size(texts); ++index) {
        const char* const text = texts[index];
        const auto expression = std::make_shared<const Expression>(text, volume.fields());
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            DeviceVolume data(test::validated_device(), volume, precision, nullptr);
            const bool is_double = precision == Precision::float64;
            const bool is_every_shape = is_double && index >= first_in_every_shape;
            const std::uint32_t first = is_every_shape ? 0 : static_cast<std::uint32_t>(index) % 4;
            for (std::uint32_t element_class = first; element_class < (is_every_shape ? 4 : first + 1); ++element_class) {
                const auto [value, gradient] = is_double ? errors<double>(volume, data, expression, element_class)
                                                         : errors<float>(volume, data, expression, element_class);
                INFO(text << ", class " << element_class << (is_double ? ", float64: " : ", float32: ") << value << ", "
                          << gradient);
                // Second derivatives of the CPU are differences, not exact where pyramids have rational functions.
                const double tolerance = !is_double ? 1e-5 : element_class == 2 ? 5e-8 : 1e-11;
                CHECK(value < tolerance);
                CHECK(gradient < tolerance);
                worst[is_double][0] = std::max(worst[is_double][0], value);
                worst[is_double][1] = std::max(worst[is_double][1], gradient);
            }
        }
    }
    std::cout << "expressions on the device, largest relative error: float32 value " << worst[0][0] << ", gradient "
              << worst[0][1] << "; float64 value " << worst[1][0] << ", gradient " << worst[1][1] << '\n';
}

} // namespace

// Single precision differs in nothing but digits, shapes in derivatives.
TEST_CASE("expressions give on the device what they give on the CPU") { check_expressions(2); }

TEST_CASE("all expressions give on the device what they give on the CPU, in every shape", "[.long]") { check_expressions(0); }

namespace {

/** A random expression over p and u, of some ten operations. */
std::string random_expression(test::Random& random, int depth) {
    const auto pick = [&](int n) { return std::min(n - 1, static_cast<int>(random.between(0, n))); };
    if (depth == 0) {
        const char* const leaves[] = {"p", "u[0]", "u[1]", "u[2]", "1.3", "2"};
        return leaves[pick(6)];
    }
    const std::string a = random_expression(random, depth - 1), b = random_expression(random, depth - 1);
    switch (pick(14)) {
    case 0:
        return "(" + a + " + " + b + ")";
    case 1:
        return "(" + a + " - " + b + ")";
    case 2:
        return "(" + a + " * " + b + ")";
    case 3:
        return "(" + a + " / (3 + abs(" + b + ")))";
    case 4:
        return "sqrt(0.5 + (" + a + ")^2)";
    case 5:
        return "sin(" + a + ")";
    case 6:
        return "exp(-abs(" + a + "))";
    case 7:
        return "log(2 + (" + a + ")^2)";
    case 8:
        return "max(" + a + ", " + b + ")";
    case 9:
        return "atan(" + a + ")";
    case 10:
        return "(1 + (" + a + ")^2)^0.3";
    case 11:
        return "(" + a + " > " + b + " ? " + a + " : " + b + ")";
    case 12:
        return "(" + a + ")^3";
    default:
        return "atan2(" + a + ", " + b + ")";
    }
}

struct Containment {
    std::size_t n_known = 0, n_outside = 0;
    double ratio = 0;
    bool is_estimated = false;
};

/** Models of an expression over small cells against samples by the CPU. */
template <class Real>
Containment check_models(const RuntimeVolume& volume, DeviceVolume& data, const std::shared_ptr<const Expression>& expression,
                         std::uint32_t element_class, double cell_size) {
    data.select(selection_of(expression, volume, 0));
    data.provide_derivative_bounds();
    KernelRequest request;
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.buffers = data.host_buffers(element_class);
    data.add_field(request, element_class, true);
    test::Random random(6);
    const std::vector<double> points = points_of(curved_volume().description().classes[element_class].geometry.shape, random);
    std::vector<double> given;
    for (std::size_t i = 0; i < n_points; ++i) {
        given.insert(given.end(), points.begin() + 3 * static_cast<std::ptrdiff_t>(i),
                     points.begin() + 3 * static_cast<std::ptrdiff_t>(i + 1));
        const double size = cell_size * random.between(0.2, 1);
        for (std::size_t k = 0; k < 12; ++k) {
            given.push_back(size * random.between(-1, 1));
        }
        given.push_back(0.1 * size);
        given.push_back(1.2 * size);
    }
    given = rounded(given);
    const std::vector<Real> results = run<Real>(request, model_kernel, given, 7);
    Containment found;
    for (std::size_t i = 0; i < n_points; ++i) {
        const Real* model = &results[7 * i + 1];
        const double* region = &given[(point_numbers + patch_numbers) * i];
        found.is_estimated = found.is_estimated || results[7 * i + 6] != 0;
        if (!(model[4] <= Real(1e30))) {
            continue;
        }
        ++found.n_known;
        double largest = 0;
        for (int sample = 0; sample < 60; ++sample) {
            std::array<double, 4> weights{};
            double sum = 0;
            for (std::size_t corner = 0; corner < 4; ++corner) {
                weights[corner] = sample < 8 ? (corner == static_cast<std::size_t>(sample) % 4 ? 1 : 0) : random.between(0, 1);
                sum += weights[corner];
            }
            std::array<double, 3> d{}, xi{};
            double linear = static_cast<double>(model[0]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t corner = 0; corner < 4; ++corner) {
                    d[axis] += weights[corner] / sum * region[3 + 3 * corner + axis];
                }
                d[axis] += random.between(-1, 1) * region[15];
                xi[axis] = region[axis] + d[axis];
                linear += static_cast<double>(model[1 + axis]) * d[axis];
            }
            VolumePoint point(volume, curved_volume().first_element(element_class) + i % 3, xi, 0);
            largest = std::max(largest, std::abs(evaluate(*expression, point) - linear));
        }
        // The CPU rounds, too.
        const double slack = 1e-14 * (1 + std::abs(static_cast<double>(model[0])));
        found.n_outside += largest > static_cast<double>(model[4]) + slack ? 1 : 0;
        found.ratio = std::max(found.ratio, largest / static_cast<double>(model[4]));
    }
    return found;
}

} // namespace

TEST_CASE("models of random expressions contain samples") {
    const RuntimeVolume volume = curved_volume().open();
    test::Random random(11);
    DeviceVolume single(test::validated_device(), volume, Precision::float32, nullptr),
        twice(test::validated_device(), volume, Precision::float64, nullptr);
    std::size_t n_known = 0, n_all = 0;
    double ratio = 0;
    for (int trial = 0; trial < 12; ++trial) {
        const std::string text = random_expression(random, 3);
        const auto expression = std::make_shared<const Expression>(text, volume.fields());
        const std::uint32_t element_class = trial % 2 == 0 ? 0 : 3;
        const Containment found = trial % 3 == 0 ? check_models<double>(volume, twice, expression, element_class, 1e-3)
                                                 : check_models<float>(volume, single, expression, element_class, 4e-3);
        INFO(text);
        CHECK(found.n_outside == 0);
        CHECK_FALSE(found.is_estimated);
        n_known += found.n_known;
        n_all += n_points;
        ratio = std::max(ratio, found.ratio);
    }
    std::cout << "models of random expressions: " << n_known << " of " << n_all << " known, largest error " << ratio
              << " of the remainder\n";
    CHECK(n_known > n_all * 3 / 4);
}

TEST_CASE("models of expressions without bounds are estimated, and labelled") {
    const RuntimeVolume volume = curved_volume().open();
    DeviceVolume data(test::validated_device(), volume, Precision::float64, nullptr);
    for (const char* const text : {"q_criterion(u)", "laplacian(p)", "p + x"}) {
        const auto expression = std::make_shared<const Expression>(text, volume.fields());
        const Containment found = check_models<double>(volume, data, expression, 0, 4e-3);
        INFO(text);
        CHECK(found.is_estimated);
        CHECK(found.n_known == n_points);
        CHECK(found.n_outside == 0);
        std::cout << "estimated model of " << text << ": largest error " << found.ratio << " of the remainder\n";
    }
}

TEST_CASE("the validation layer has nothing to say about expressions") {
    CHECK(test::validated_device().validation_messages().empty());
}
