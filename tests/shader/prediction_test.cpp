// How far a prediction of Newton's method is off, where the answer is known.
#include "fixture.hpp"

#include <tests/support/device.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <random>
#include <vector>

using namespace elvis;

namespace {

constexpr std::uint32_t n_trials = 4096;

constexpr const char* kernel_text = R"(
layout(local_size_x = 64) in;
#include "element/prediction.glsl"
layout(std430, set = 0, binding = 0) readonly buffer given_block { float given[]; };
layout(std430, set = 0, binding = 1) writeonly buffer results_block { float results[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    results[2u * i] = float(core_prediction_error(elvis_real(given[3u * i]), elvis_real(given[3u * i + 1u])));
    results[2u * i + 1u] = float(core_prediction_error_within(elvis_real(given[3u * i]), elvis_real(given[3u * i + 1u]),
                                                              elvis_real(given[3u * i + 2u])));
}
)";

} // namespace

TEST_CASE("A prediction's error is bounded for the far solution, too") {
    // The mapping x - C x^2 of curvature C: from 0, a target at d is predicted at s = d - C d^2, which is C d^2 off.
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> given, errors;
    for (std::uint32_t i = 0; i < n_trials; ++i) {
        const float curvature = 2 * uniform(random), farthest = 3 * uniform(random);
        const float d = farthest * (2 * uniform(random) - 1);
        given.insert(given.end(), {curvature, std::abs(d - curvature * d * d), farthest});
        errors.push_back(curvature * d * d);
    }
    KernelRequest request;
    request.name = request.kernel = "prediction test";
    request.kernel_text = kernel_text;
    request.precision = Precision::float32;
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    const ComposedKernel kernel(test::validated_device(), request);
    const Buffer input(test::validated_device(), given.size() * sizeof(float));
    const Buffer output(test::validated_device(), 2 * n_trials * sizeof(float));
    input.write_items<float>(given);
    const Buffer* const bindings[]{&input, &output};
    kernel.dispatch(bindings, {}, n_trials / 64);
    const std::vector<float> bounds = output.read_items<float>(2 * n_trials);
    int n_broken_near = 0, n_broken = 0, n_sharp = 0;
    for (std::uint32_t i = 0; i < n_trials; ++i) {
        const float known = errors[i] * (1 - 1e-4F) - 1e-6F;
        n_broken_near += bounds[2 * i] < known ? 1 : 0;
        n_broken += bounds[2 * i + 1] < known ? 1 : 0;
        n_sharp += bounds[2 * i + 1] < 1.01F * errors[i] + 1e-6F ? 1 : 0;
    }
    std::cout << "predictions: the bound for the near solution is broken by " << n_broken_near << " of " << n_trials
              << " solutions, the one for all by " << n_broken << "; sharp for " << n_sharp << "\n";
    CHECK(n_broken == 0);
    CHECK(n_broken_near > 100);
    CHECK(n_sharp > 500);
}
