// Implicit functions on the device: values, gradients, and ranges over boxes that hold.
#include <core/expression/evaluate.hpp>
#include <core/expression/glsl.hpp>
#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <random>

using namespace elvis;

namespace {

constexpr const char* kernel = R"(
layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) readonly buffer core_given_block { elvis_real core_given[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { elvis_real core_results[]; };
void main() {
    const uint i = gl_GlobalInvocationID.x, at = 6u * i;
    const elvis_vec3 lower = elvis_vec3(core_given[at], core_given[at + 1u], core_given[at + 2u]);
    const elvis_vec3 upper = elvis_vec3(core_given[at + 3u], core_given[at + 4u], core_given[at + 5u]);
    const core_interval range = core_implicit_range(core_interval(lower.x, upper.x), core_interval(lower.y, upper.y),
                                                    core_interval(lower.z, upper.z));
    elvis_real value;
    elvis_vec3 gradient;
    core_implicit(lower, value, gradient);
    core_results[7u * i] = range.lower;
    core_results[7u * i + 1u] = range.upper;
    core_results[7u * i + 2u] = core_implicit_value(lower);
    core_results[7u * i + 3u] = value;
    core_results[7u * i + 4u] = gradient.x;
    core_results[7u * i + 5u] = gradient.y;
    core_results[7u * i + 6u] = gradient.z;
}
)";

constexpr std::size_t n_boxes = 512;

template <class Real> void check(const Device& device, const std::string& text, const std::array<double, 3>& origin = {}) {
    const Expression expression = Expression::implicit(text);
    KernelRequest request;
    request.name = "implicit " + text;
    request.kernel = "implicit";
    request.kernel_text = kernel;
    request.text = implicit_glsl(expression, origin);
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    const ComposedKernel composed(device, request);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Real> boxes;
    for (std::size_t i = 0; i < n_boxes; ++i) {
        const double size = std::exp2(-10 * unit(random));
        std::array<double, 3> lower{};
        for (double& coordinate : lower) {
            coordinate = 4 * unit(random) - 2.5;
            boxes.push_back(static_cast<Real>(coordinate));
        }
        for (const double coordinate : lower) {
            boxes.push_back(static_cast<Real>(coordinate + size * unit(random)));
        }
    }
    const Buffer input(device, boxes.size() * sizeof(Real)), output(device, 7 * n_boxes * sizeof(Real));
    input.write_items<Real>(boxes);
    const Buffer* const bindings[]{&input, &output};
    composed.dispatch(bindings, {}, n_boxes / 32);
    const std::vector<Real> results = output.read_items<Real>(7 * n_boxes);
    // The CPU rounds, too, coordinates as large as these.
    const double cpu = 1e-15 * (std::abs(origin[0]) + std::abs(origin[1]) + std::abs(origin[2]));
    const double roundoff = (sizeof(Real) == 8 ? 1e-13 : 1e-5) + 0.1 * cpu;
    std::size_t n_outside = 0, n_bounded = 0;
    for (std::size_t i = 0; i < n_boxes; ++i) {
        const Real* box = &boxes[6 * i];
        const Real* result = &results[7 * i];
        n_bounded += result[0] > Real(-1e38) && result[1] < Real(1e38) ? 1 : 0;
        for (int sample = 0; sample < 60; ++sample) {
            std::array<double, 3> x{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double s = sample < 16 ? (sample >> axis) & 1 : unit(random);
                x[axis] = origin[axis] + static_cast<double>(box[axis]) +
                          s * (static_cast<double>(box[3 + axis]) - static_cast<double>(box[axis]));
            }
            const double value = evaluate_implicit(expression, x).value;
            const double slack = 1e-14 * (1 + std::abs(value)) + cpu;
            n_outside +=
                value < static_cast<double>(result[0]) - slack || value > static_cast<double>(result[1]) + slack ? 1 : 0;
        }
        const ValueAndGradient exact =
            evaluate_implicit(expression, {origin[0] + static_cast<double>(box[0]), origin[1] + static_cast<double>(box[1]),
                                           origin[2] + static_cast<double>(box[2])});
        if (!std::isfinite(exact.value) || !std::isfinite(exact.gradient[0] + exact.gradient[1] + exact.gradient[2])) {
            continue;
        }
        double scale = 10 + std::abs(exact.value);
        for (const double slope : exact.gradient) {
            scale += std::abs(slope);
        }
        CHECK(std::abs(static_cast<double>(result[2]) - exact.value) <= roundoff * scale);
        CHECK(std::abs(static_cast<double>(result[3]) - exact.value) <= roundoff * scale);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Slopes near a root's branch point amplify rounding of the argument.
            CHECK(std::abs(static_cast<double>(result[4 + axis]) - exact.gradient[axis]) <= 20 * roundoff * scale * scale);
        }
    }
    INFO(text);
    CHECK(n_outside == 0);
    CHECK(n_bounded > n_boxes / 2);
}

} // namespace

TEST_CASE("implicit functions and their ranges over boxes hold on the device") {
    const Device device;
    for (const char* const text : {
             "(sqrt(x^2 + y^2) - 2)^2 + z^2 - 0.25",
             "x^4 + y^4 + z^4 - 1.5 * (x^2 + y^2 + z^2) + 1",
             "sin(3 * x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)",
             "x^2 / (1 + y^2) - exp(-z) + abs(x - y)^1.5 + log(3 + x)",
             "min(norm(x * grad(x) + y * grad(y)) - 1, max(atan2(y, x + 3), z))",
             "x > 0 ? tan(y / 4) : asin(x / 4) + acos(y / 4) + atan(z) + pow(3 + x, y)",
             "d(x^3 * y, x) - x^-2",
         }) {
        check<float>(device, text);
        check<double>(device, text);
    }
}

TEST_CASE("implicit functions keep their digits far from the world's origin") {
    const Device device;
    const std::array<double, 3> origin{10000, -20000, 4096};
    for (const char* const text : {
             "(x - 10000.25)^2 + (y + 20000.5)^2 + (4096 - z)^2 - 1.5",
             "sin(3 * (x - 9999.625)) * cos(y + 20000) + exp(0.5 * (z - 4096)) * (2 * x - 20000) / 4",
             "(x - 10000 > 0 ? atan2(y + 20000, x - 9990) : 1) + norm(grad((x - 10000)^2 + (y + 20001)^2 + z)) - z / 2",
         }) {
        check<float>(device, text, origin);
        check<double>(device, text, origin);
    }
}
