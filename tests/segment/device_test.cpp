// The segment polynomial on the device against its twin on the CPU, in both precisions.
#include "random.hpp"

#include <core/segment/colleague.hpp>
#include <core/segment/crossings.hpp>
#include <core/segment/fit.hpp>
#include <core/shader/composer.hpp>
#include <tests/support/device.hpp>

#include <catch2/catch.hpp>

#include <iostream>

using namespace elvis;
using namespace elvis::segment;

namespace {

constexpr std::uint32_t n_trials = 512;
constexpr std::uint32_t group_size = 64;
constexpr std::size_t n_crossings = 12;

template <class Real>
std::vector<Real> run(const std::string& text, const SamplePlan& plan, const std::vector<Real>& given, std::size_t n_results) {
    KernelRequest request;
    request.name = request.kernel = "segment test";
    request.kernel_text = R"(
const elvis_real level_values[3] = {elvis_real(-0.25LF), elvis_real(0), elvis_real(0.5LF)};
elvis_real core_listed_value(uint i) { return level_values[i]; }
#include "segments/polynomial.glsl"
#include "segments/colleague.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer given_block { elvis_real given[]; };
layout(set = 0, binding = 1, std430) writeonly buffer results_block { elvis_real results[]; };
)" + text;
    request.text = segment_glsl(plan);
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    const ComposedKernel kernel(test::validated_device(), request);
    const Buffer input(test::validated_device(), given.size() * sizeof(Real)),
        output(test::validated_device(), n_trials * n_results * sizeof(Real));
    input.write_items<Real>(given);
    const Buffer* const bindings[]{&input, &output};
    kernel.dispatch(bindings, {}, n_trials / group_size);
    return output.read_items<Real>(n_trials * n_results);
}

constexpr const char* bernstein_kernel = R"(
void main() {
    const uint i = gl_GlobalInvocationID.x, size = CORE_FIT_SIZE, at = i * (size + 3u), to = i * (2u * size + 6u);
    core_polynomial chebyshev;
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        chebyshev.c[k] = given[at + uint(k)];
    }
    const elvis_real t = given[at + size];
    const core_polynomial p = core_to_bernstein(chebyshev);
    const core_polynomial interval = core_restricted(p, uint(given[at + size + 1u]), uint(given[at + size + 2u]));
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        results[to + uint(k)] = p.c[k];
        results[to + size + uint(k)] = interval.c[k];
    }
    results[to + 2u * size] = core_bernstein_rounding(chebyshev);
    results[to + 2u * size + 1u] = core_least(interval);
    results[to + 2u * size + 2u] = core_most(interval);
    results[to + 2u * size + 3u] = core_bernstein_value(p, t);
    results[to + 2u * size + 4u] = core_is_monotone(interval) ? elvis_real(1) : elvis_real(0);
    results[to + 2u * size + 5u] = elvis_real(core_variations(interval, elvis_real(0.0625LF)));
}
)";

constexpr const char* crossings_kernel = R"(
void main() {
    const uint i = gl_GlobalInvocationID.x, size = CORE_FIT_SIZE, to = i * 49u;
    core_polynomial chebyshev;
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        chebyshev.c[k] = given[i * size + uint(k)];
    }
    const core_polynomial p = core_to_bernstein(chebyshev);
    const elvis_real error = core_bernstein_rounding(chebyshev);
    core_isolation isolation = core_isolation_begin();
    for (uint k = 0u; k < 12u; ++k) {
        const core_crossing crossing = core_next_crossing(p, error, 3u, isolation);
        results[to + 4u * k] = elvis_real(crossing.kind);
        results[to + 4u * k + 1u] = elvis_real(crossing.index);
        results[to + 4u * k + 2u] = crossing.t;
        results[to + 4u * k + 3u] = crossing.upper - crossing.lower;
    }
    const core_colleague_root root = core_first_root_by_colleague(chebyshev, elvis_real(0.5LF), elvis_real(0));
    results[to + 48u] = root.has_failed ? elvis_real(3) : root.t;
}
)";

constexpr const char* fit_kernel = R"(
void main() {
    const uint i = gl_GlobalInvocationID.x, size = CORE_FIT_SIZE, to = i * (size + 4u);
    core_fit_samples sampled = core_fit_begin();
    core_fit fit;
    bool is_over = false;
    while (!is_over) {
        const elvis_real t = core_fit_parameter(sampled);
        const elvis_real value = elvis_exp(given[4u * i] * t) * elvis_sin(given[4u * i + 1u] * t + given[4u * i + 2u]);
        core_fit_add(sampled, t == given[4u * i + 3u] ? value / (t - given[4u * i + 3u]) : value, CORE_ROUNDOFF);
        if (core_fit_is_decision(sampled)) {
            fit = core_fit_of(sampled);
            is_over = !sampled.is_finite || fit.error <= elvis_real(1e-3LF) || core_fit_is_full(sampled);
        }
    }
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        results[to + uint(k)] = fit.chebyshev.c[k];
    }
    results[to + size] = fit.error;
    results[to + size + 1u] = elvis_real(!sampled.is_finite ? 3 : fit.error <= elvis_real(1e-3LF) ? 1 : 2);
    results[to + size + 2u] = elvis_real(sampled.n_samples);
    results[to + size + 3u] = elvis_real(fit.degree);
}
)";

template <class Real> const char* name() { return sizeof(Real) == 8 ? "float64" : "float32"; }

/** Polynomials at the edges of what can be told. */
template <class Real> std::vector<std::array<Real, max_degree + 1>> special_polynomials() {
    constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), small = 4 * roundoff<Real>;
    return {
        {nan, nan, nan},
        // Constant; stops just below a value, just above; starts there; touches in the middle, nearly.
        {Real(0.5)},
        {-small, Real(0.5)},
        {small, Real(0.5)},
        {1 + small, Real(0.5)},
        {1 - small, Real(0.5)},
        {Real(0.125), 0, Real(0.125)},
        {Real(0.125) + small, 0, Real(0.125)},
        {Real(0.125) - small, 0, Real(0.125)},
    };
}

/** What the device found of crossings, compared with the CPU. */
struct CrossingDifferences {
    std::size_t n_found = 0;
    /** Polynomials of other intervals or kinds. */
    std::size_t n_differing = 0;
    /** Of the rest, in the polynomial's value: what rounding moves a root is the more the flatter the polynomial. In units of
     * the stated rounding. */
    double worst = 0;

    template <class Real> void add(const Polynomial<Real>& bernstein, Real rounding, const Real* found) {
        const std::vector<Real> values{Real(-0.25), 0, Real(0.5)};
        Isolation isolation;
        bool differs = false;
        double largest = 0;
        for (std::size_t k = 0; k < n_crossings; ++k, found += 4) {
            const auto crossing = next_crossing<Real>(bernstein, rounding, values, isolation);
            n_found += crossing.kind != CrossingKind::none ? 1 : 0;
            differs = differs || found[0] != static_cast<Real>(crossing.kind) ||
                      found[1] != static_cast<Real>(crossing.index) || found[3] != crossing.upper - crossing.lower;
            const double moved =
                std::abs(static_cast<double>(bernstein_value(bernstein, found[2]) - bernstein_value(bernstein, crossing.t)));
            largest = std::max(largest, moved / static_cast<double>(rounding));
        }
        n_differing += differs ? 1 : 0;
        worst = std::max(worst, differs ? 0 : largest);
    }
};

} // namespace

TEMPLATE_TEST_CASE("The Bernstein form on the device is that on the CPU", "", float, double) {
    double worst = 0;
    for (const int degree : {2, 5, 8, 13}) {
        test::Random random(8);
        const auto size = static_cast<std::size_t>(degree + 1), n_given = size + 3, n_results = 2 * size + 6;
        std::vector<TestType> given;
        std::vector<Polynomial<TestType>> polynomials;
        for (std::uint32_t i = 0; i < n_trials; ++i) {
            polynomials.push_back(random.chebyshev<TestType>(degree));
            given.insert(given.end(), polynomials.back().c.begin(), polynomials.back().c.begin() + degree + 1);
            const double level = std::floor(random.between(0, 7));
            given.push_back(static_cast<TestType>(random.between(0, 1)));
            given.push_back(static_cast<TestType>(level));
            given.push_back(static_cast<TestType>(std::floor(random.between(0, std::exp2(level)))));
        }
        const auto results = run<TestType>(bernstein_kernel, fixed_plan(degree), given, n_results);
        std::size_t n_decided = 0;
        for (std::uint32_t i = 0; i < n_trials; ++i) {
            const TestType* const result = &results[i * n_results];
            const TestType* const more = &given[i * n_given + size];
            const Polynomial<TestType> p = to_bernstein(polynomials[i]);
            const Polynomial<TestType> interval =
                restricted(p, static_cast<std::uint32_t>(more[1]), static_cast<std::uint32_t>(more[2]));
            const TestType rounding = bernstein_rounding(polynomials[i]);
            const auto differ = [&](TestType a, TestType b) {
                worst = std::max(worst, static_cast<double>(std::abs(a - b) / rounding));
            };
            TestType nearest = 1, flattest = 1;
            for (int k = 0; k <= degree; ++k) {
                differ(result[k], p[k]);
                differ(result[degree + 1 + k], interval[k]);
                nearest = std::min(nearest, std::abs(interval[k] - TestType(0.0625)));
                flattest = k == 0 ? flattest : std::min(flattest, std::abs(interval[k] - interval[k - 1]));
            }
            const TestType* const rest = result + 2 * size;
            CHECK(rest[0] == Approx(rounding).epsilon(1e-5));
            differ(rest[1], range(interval)[0]);
            differ(rest[2], range(interval)[1]);
            differ(rest[3], bernstein_value(p, more[0]));
            // Where rounding does not decide.
            if (std::min(nearest, flattest) > rounding) {
                n_decided += 1;
                CHECK((rest[4] != 0) == is_monotone(interval));
                CHECK(static_cast<std::uint32_t>(rest[5]) == variations(interval, TestType(0.0625)));
            }
        }
        CHECK(n_decided > n_trials / 10);
    }
    std::cout << "Bernstein form, device and CPU, " << name<TestType>() << ": largest difference " << worst
              << " of the stated rounding\n";
    CHECK(worst < 1);
}

TEMPLATE_TEST_CASE("Crossings on the device are those on the CPU", "", float, double) {
    const std::size_t n_results = 4 * n_crossings + 1;
    const auto special = special_polynomials<TestType>();
    CrossingDifferences differences;
    double worst_root = 0;
    std::size_t n_roots = 0;
    for (const int degree : {2, 5, 8}) {
        test::Random random(9);
        std::vector<TestType> given;
        std::vector<Polynomial<TestType>> polynomials;
        for (std::uint32_t i = 0; i < n_trials; ++i) {
            polynomials.push_back(random.chebyshev<TestType>(degree));
            if (i < special.size()) {
                polynomials.back().c = special[i];
            }
            given.insert(given.end(), polynomials.back().c.begin(), polynomials.back().c.begin() + degree + 1);
        }
        const auto results = run<TestType>(crossings_kernel, fixed_plan(degree), given, n_results);
        CHECK(results[0] == 0);
        CHECK(results[n_results] == 3);
        CHECK(results[n_results + 1] == 2);
        // After crossings of -0.25 and 0 comes the end.
        CHECK(results[2 * n_results + 8] == 3);
        CHECK(results[2 * n_results + 10] == 1);
        CHECK(results[4 * n_results] == 3);
        CHECK(results[4 * n_results + 2] == 0);
        for (std::uint32_t i = 1; i < n_trials; ++i) {
            const Polynomial<TestType> p = to_bernstein(polynomials[i]);
            differences.add(p, bernstein_rounding(polynomials[i]), &results[i * n_results]);
            Polynomial<double> exact{degree, {}};
            std::copy(polynomials[i].c.begin(), polynomials[i].c.end(), exact.c.begin());
            const std::vector<double> roots = roots_by_colleague(exact, 0.5);
            const auto root = static_cast<double>(results[i * n_results + 4 * n_crossings]);
            REQUIRE(root != 3);
            if (i >= special.size() && !roots.empty() && root <= 1) {
                n_roots += 1;
                const double value = std::abs(chebyshev_value(exact, root) - 0.5);
                worst_root = std::max(worst_root, value);
            } else if (i >= special.size()) {
                differences.n_differing += roots.empty() == (root > 1) ? 0 : 1;
            }
        }
    }
    std::cout << "crossings, device and CPU, " << name<TestType>() << ": " << differences.n_found << ", "
              << differences.n_differing << " polynomials of other intervals or kinds; largest difference " << differences.worst
              << " of the stated rounding, in the polynomial's value; colleague matrix: " << n_roots
              << " roots, largest residual " << worst_root << '\n';
    CHECK(differences.n_found > n_trials);
    CHECK(differences.n_differing <= 3);
    CHECK(differences.worst < 1);
    CHECK(n_roots > n_trials / 4);
    CHECK(worst_root < (sizeof(TestType) == 8 ? 1e-12 : 1e-3));
}

TEMPLATE_TEST_CASE("Fits on the device are those on the CPU", "", float, double) {
    const SamplePlan plan = nested_plan();
    constexpr std::size_t n_results = 9 + 4;
    test::Random random(10);
    std::vector<TestType> given;
    for (std::uint32_t i = 0; i < n_trials; ++i) {
        const double steep = random.between(-2, 2), frequency = random.between(0, i % 2 == 0 ? 12 : 3),
                     phase = random.between(0, 6);
        // Now and then a sample is divided by zero.
        const double pole = i % 8 == 0 ? plan.parameters[i / 8 % plan.parameters.size()] : -1;
        for (const double number : {steep, frequency, phase, pole}) {
            given.push_back(static_cast<TestType>(number));
        }
    }
    const auto results = run<TestType>(fit_kernel, plan, given, n_results);
    double worst = 0, worst_error = 0;
    std::size_t n_differing = 0;
    std::array<std::size_t, 4> n_status{};
    for (std::uint32_t i = 0; i < n_trials; ++i) {
        const TestType* const parameters = &given[4 * i];
        FitSamples<TestType> segment(plan);
        while (segment.status() == FitStatus::wants) {
            const TestType t = segment.parameter();
            const TestType value = std::exp(parameters[0] * t) * std::sin(parameters[1] * t + parameters[2]);
            segment.add(t == parameters[3] ? value / (t - parameters[3]) : value, roundoff<TestType>, TestType(1e-3));
        }
        const Fit<TestType> fit = segment.fit();
        const TestType* const result = &results[i * n_results];
        n_status[static_cast<std::size_t>(segment.status())] += 1;
        if (result[10] != static_cast<TestType>(segment.status()) || result[11] != static_cast<TestType>(segment.n_samples())) {
            n_differing += 1;
            continue;
        }
        if (segment.status() != FitStatus::not_finite) {
            CHECK(result[12] == static_cast<TestType>(fit.degree));
            for (int k = 0; k <= 8; ++k) {
                worst = std::max(worst, static_cast<double>(std::abs(result[k] - fit.chebyshev[k])));
            }
            worst_error = std::max(worst_error, static_cast<double>(std::abs(result[9] - fit.error)));
        }
    }
    std::cout << "fits, device and CPU, " << name<TestType>() << ": " << n_status[1] << " done, " << n_status[2]
              << " to split, " << n_status[3] << " not finite; " << n_differing
              << " differ in status; largest difference of coefficients " << worst << ", of error estimates " << worst_error
              << '\n';
    CHECK(n_status[1] > n_trials / 8);
    CHECK(n_status[2] > n_trials / 8);
    CHECK(n_status[3] > n_trials / 20);
    CHECK(n_differing <= 2);
    // Values are at most 8.
    CHECK(worst < 64 * static_cast<double>(roundoff<TestType>));
    CHECK(worst_error < 256 * static_cast<double>(roundoff<TestType>));
}

TEST_CASE("the validation layer has nothing to say about segments") {
    CHECK(test::validated_device().validation_messages().empty());
}
