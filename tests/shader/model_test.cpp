// Taylor models (shaders/arithmetic/model.glsl) and intervals (interval.glsl) contain what they are to contain: dense samples,
// computed with 80 bits.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>

using namespace elvis;

namespace {

using Function = long double (*)(long double f, long double g);

struct Operation {
    const char* name;
    const char* model;
    /** Empty: not for intervals. */
    const char* interval;
    Function function;
    /** Both operands are shifted by this, so that their values lie where the function is of interest. */
    double shift;
};

// The value of a function that has none counts as contained.
const Operation operations[] = {
    {"f + g", "core_model_add(f, g, region)", "core_interval_add(f, g)", [](long double f, long double g) { return f + g; }, 0},
    {"f - g", "core_model_subtract(f, g, region)", "core_interval_subtract(f, g)",
     [](long double f, long double g) { return f - g; }, 0},
    {"3 f", "core_model_scale(elvis_real(3), f, region)", "core_interval_multiply(core_interval_number(elvis_real(3)), f)",
     [](long double f, long double) { return 3 * f; }, 0},
    {"f g", "core_model_multiply(f, g, region)", "core_interval_multiply(f, g)",
     [](long double f, long double g) { return f * g; }, 0},
    {"f / g", "core_model_divide(f, g, region)", "core_interval_divide(f, g)",
     [](long double f, long double g) { return f / g; }, 2},
    {"f^2", "core_model_square(f, region)", "core_interval_square(f)", [](long double f, long double) { return f * f; }, 0},
    {"f^5", "core_model_whole_power(f, 5u, region)", "core_interval_whole_power(f, 5u)",
     [](long double f, long double) { return f * f * f * f * f; }, 0},
    {"f^6", "core_model_whole_power(f, 6u, region)", "core_interval_whole_power(f, 6u)",
     [](long double f, long double) { return f * f * f * f * f * f; }, 0},
    {"sqrt(f)", "core_model_sqrt(f, region)", "core_interval_sqrt(f)", [](long double f, long double) { return std::sqrt(f); },
     1},
    {"length(f, g, 1)", "core_model_length(f, g, core_model_constant(elvis_real(1)), region)", "",
     [](long double f, long double g) { return std::sqrt(f * f + g * g + 1); }, 0},
    {"length(f, g, 0)", "core_model_length(f, g, core_model_constant(elvis_real(0)), region)", "",
     [](long double f, long double g) { return std::sqrt(f * f + g * g); }, 0},
    {"abs(f)", "core_model_abs(f, region)", "core_interval_abs(f)", [](long double f, long double) { return std::abs(f); }, 0},
    {"min(f, g)", "core_model_min(f, g, region)", "core_interval_min(f, g)",
     [](long double f, long double g) { return std::min(f, g); }, 0},
    {"max(f, g)", "core_model_max(f, g, region)", "core_interval_max(f, g)",
     [](long double f, long double g) { return std::max(f, g); }, 0},
    {"exp(f)", "core_model_exp(f, region)", "core_interval_exp(f)", [](long double f, long double) { return std::exp(f); }, 0},
    {"log(f)", "core_model_log(f, region)", "core_interval_log(f)", [](long double f, long double) { return std::log(f); }, 2},
    {"sin(f)", "core_model_sin(f, region)", "core_interval_sin(f)", [](long double f, long double) { return std::sin(f); }, 0},
    {"cos(f)", "core_model_cos(f, region)", "core_interval_cos(f)", [](long double f, long double) { return std::cos(f); }, 0},
    {"tan(f)", "core_model_tan(f, region)", "core_interval_tan(f)", [](long double f, long double) { return std::tan(f); }, 0},
    {"asin(f)", "core_model_asin(f, region)", "core_interval_asin(f)", [](long double f, long double) { return std::asin(f); },
     0},
    {"acos(f)", "core_model_acos(f, region)", "core_interval_acos(f)", [](long double f, long double) { return std::acos(f); },
     0},
    {"atan(f)", "core_model_atan(f, region)", "core_interval_atan(f)", [](long double f, long double) { return std::atan(f); },
     0},
    {"atan2(f, g)", "core_model_atan(f, g, region)", "core_interval_atan(f, g)",
     [](long double f, long double g) { return std::atan2(f, g); }, 0},
    {"f^0.3", "core_model_power(f, elvis_real(0.3LF), region)", "core_interval_power(f, core_interval_near(elvis_real(0.3LF)))",
     [](long double f, long double) { return std::pow(f, 0.3L); }, 2},
    {"f^g", "core_model_power(f, g, region)", "core_interval_power(f, g)",
     [](long double f, long double g) { return std::pow(f, g); }, 2},
};

constexpr const char* model_text = R"(
#include "arithmetic/model.glsl"
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) readonly buffer input_block { elvis_real given[]; };
layout(std430, set = 0, binding = 1) writeonly buffer result_block { elvis_real result[]; };

elvis_vec3 three(uint first) { return elvis_vec3(given[first], given[first + 1u], given[first + 2u]); }

void main() {
    const uint i = gl_GlobalInvocationID.x;
    const uint at = 28u * i;
    const core_region region = core_region(three(at), three(at + 3u), three(at + 6u), three(at + 9u), given[at + 12u], given[at + 13u]);
    const elvis_vec3 bend_f = abs(three(at + 18u)), bend_g = abs(three(at + 25u));
    const core_model f = core_model_leaf(given[at + 14u], three(at + 15u), elvis_vec3(bend_f.x + bend_f.y + bend_f.z, 0, 0), region);
    const core_model g = core_model_leaf(given[at + 21u], three(at + 22u), elvis_vec3(bend_g.x + bend_g.y + bend_g.z, 0, 0), region);
    const core_model h = OPERATION;
    result[5u * i] = h.value;
    result[5u * i + 1u] = h.slope.x;
    result[5u * i + 2u] = h.slope.y;
    result[5u * i + 3u] = h.slope.z;
    result[5u * i + 4u] = h.remainder;
}
)";

constexpr const char* interval_text = R"(
#include "arithmetic/interval.glsl"
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) readonly buffer input_block { elvis_real given[]; };
layout(std430, set = 0, binding = 1) writeonly buffer result_block { elvis_real result[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    const core_interval f = core_interval(given[4u * i], given[4u * i + 1u]);
    const core_interval g = core_interval(given[4u * i + 2u], given[4u * i + 3u]);
    const core_interval h = OPERATION;
    result[2u * i] = h.lower;
    result[2u * i + 1u] = h.upper;
}
)";

template <class Real>
std::vector<Real> run(const Device& device, const char* text, const char* operation, const std::vector<Real>& given,
                      std::size_t n, std::size_t n_results) {
    KernelRequest request;
    request.name = operation;
    request.kernel = operation;
    request.kernel_text = text;
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.defines = {{"OPERATION", operation}};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    const ComposedKernel kernel(device, request);
    const Buffer input(device, given.size() * sizeof(Real));
    const Buffer output(device, n * n_results * sizeof(Real));
    input.write_items<Real>(given);
    const Buffer* const bindings[]{&input, &output};
    kernel.dispatch(bindings, {}, static_cast<std::uint32_t>(n / 32));
    return output.read_items<Real>(n * n_results);
}

constexpr std::size_t n_cases = 512;

template <class Real> std::vector<Real> model_cases(double shift) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Real> given;
    for (std::size_t i = 0; i < n_cases; ++i) {
        // Cells of all sizes from a pixel of a fine picture to a whole element.
        const double size = std::exp2(4 * unit(random) - 5);
        for (int k = 0; k < 12; ++k) {
            given.push_back(static_cast<Real>(size * unit(random)));
        }
        given.push_back(static_cast<Real>(0.1 * size));
        given.push_back(static_cast<Real>(1.2 * size));
        for (int operand = 0; operand < 2; ++operand) {
            given.push_back(static_cast<Real>(shift + 1.5 * unit(random)));
            for (int k = 0; k < 6; ++k) {
                given.push_back(static_cast<Real>(unit(random)));
            }
        }
    }
    return given;
}

/** value + slope d + d^T diag(bend) d / 2 of an operand whose seven numbers begin at `of`. */
template <class Real> long double operand(const Real* of, const std::array<long double, 3>& d) {
    long double sum = of[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sum += of[1 + axis] * d[axis] + of[4 + axis] * d[axis] * d[axis] / 2;
    }
    return sum;
}

template <class Real> void check_model(const Device& device, const Operation& operation) {
    const std::vector<Real> given = model_cases<Real>(operation.shift);
    const std::vector<Real> result = run(device, model_text, operation.model, given, n_cases, 5);
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    std::size_t n_known = 0, n_outside = 0;
    double ratio = 0;
    for (std::size_t i = 0; i < n_cases; ++i) {
        const Real* region = &given[28 * i];
        const Real* model = &result[5 * i];
        if (!(model[4] <= Real(1e30))) {
            CHECK(model[4] >= Real(1e38));
            continue;
        }
        ++n_known;
        long double largest = 0;
        for (int sample = 0; sample < 300; ++sample) {
            // Corners and their neighbourhood first, where extremes are; then anywhere.
            std::array<double, 4> weights{};
            double sum = 0;
            for (std::size_t corner = 0; corner < 4; ++corner) {
                weights[corner] = sample < 40 ? (corner == static_cast<std::size_t>(sample) % 4 ? 1 : 0) : unit(random);
                sum += weights[corner];
            }
            std::array<long double, 3> d{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t corner = 0; corner < 4; ++corner) {
                    d[axis] += static_cast<long double>(weights[corner] / sum) * region[3 * corner + axis];
                }
                d[axis] += (sample % 3 == 0   ? 2 * unit(random) - 1
                            : sample % 3 == 1 ? 1
                                              : -1) *
                           static_cast<long double>(region[12]);
            }
            const long double exact = operation.function(operand(region + 14, d), operand(region + 21, d));
            const long double linear = model[0] + model[1] * d[0] + model[2] * d[1] + model[3] * d[2];
            if (!std::isnan(exact)) {
                largest = std::max(largest, std::abs(exact - linear));
            }
        }
        n_outside += largest > model[4] ? 1 : 0;
        ratio = std::max(ratio, static_cast<double>(largest / model[4]));
    }
    std::cout << (sizeof(Real) == 8 ? "float64 " : "float32 ") << operation.name << ": " << n_known << " of " << n_cases
              << " cells known, largest error " << ratio << " of the remainder\n";
    CHECK(n_outside == 0);
    CHECK(n_known > n_cases / 3);
}

template <class Real> void check_interval(const Device& device, const Operation& operation) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Real> given;
    for (std::size_t i = 0; i < 4096; ++i) {
        for (int k = 0; k < 2; ++k) {
            const double size = 3 * std::exp2(-12 * unit(random)), start = operation.shift - 3 + 5 * unit(random);
            given.push_back(static_cast<Real>(start));
            // Points are intervals, too.
            given.push_back(i % 7 == 0 ? given.back() : static_cast<Real>(start + size));
        }
    }
    const std::vector<Real> result = run(device, interval_text, operation.interval, given, 4096, 2);
    std::size_t n_outside = 0, n_bounded = 0;
    for (std::size_t i = 0; i < 4096; ++i) {
        const Real* ends = &given[4 * i];
        for (int sample = 0; sample < 40; ++sample) {
            const auto pick = [&](int which) {
                return which == 0 ? 0.0L : which == 1 ? 1.0L : static_cast<long double>(unit(random));
            };
            const long double a = pick(sample % 3), b = pick(sample / 3 % 3);
            const long double f = ends[0] + a * (static_cast<long double>(ends[1]) - ends[0]);
            const long double g = ends[2] + b * (static_cast<long double>(ends[3]) - ends[2]);
            const long double exact = operation.function(f, g);
            n_outside += exact < result[2 * i] || exact > result[2 * i + 1] ? 1 : 0;
        }
        n_bounded += result[2 * i] > Real(-1e38) && result[2 * i + 1] < Real(1e38) ? 1 : 0;
    }
    INFO(operation.name);
    CHECK(n_outside == 0);
    CHECK(n_bounded > 4096 / 3);
}

} // namespace

TEST_CASE("Taylor models contain the functions they stand for") {
    const test::CacheFolder cache;
    const Device device;
    for (const Operation& operation : operations) {
        INFO(operation.name);
        check_model<float>(device, operation);
        if (device.summary().has_float64) {
            check_model<double>(device, operation);
        }
    }
}

TEST_CASE("intervals contain the functions they stand for") {
    const test::CacheFolder cache;
    const Device device;
    for (const Operation& operation : operations) {
        if (operation.interval[0] != '\0') {
            check_interval<float>(device, operation);
            if (device.summary().has_float64) {
                check_interval<double>(device, operation);
            }
        }
    }
}
