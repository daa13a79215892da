#include <core/bench/roots.hpp>

#include <core/base/float_rounding.hpp>
#include <core/render/device/device_time.hpp>
#include <core/segment/colleague.hpp>
#include <core/segment/crossings.hpp>
#include <core/shader/composer.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <random>
#include <vector>

namespace elvis {

namespace {

using segment::Polynomial;

constexpr int least_degree = 2, most_degree = 12;
constexpr std::uint32_t roots_group_size = 64;
/** Lanes of a subgroup, in which times are given. */
constexpr double n_lanes = 8;
constexpr double no_root = 2;

/** What a method says of a polynomial: the first crossing, and between what ends the touches before it lie. */
struct Answer {
    double crossing = no_root, touch_from = no_root, touch_to = 0;
};
constexpr std::size_t n_answer = 3;

struct Answers {
    std::vector<Answer> answers;
    double nanoseconds = 0;
};

/** How far the root of a polynomial in this precision may lie from the true one, where p changes its sign over this distance.
 */
double reach(Precision precision) { return precision == Precision::float64 ? 1e-7 : 1e-3; }

/** Coefficients that single precision holds, so that all solve the same problem. */
std::vector<Polynomial<double>> random_polynomials(int degree, std::uint64_t count) {
    std::mt19937_64 random(static_cast<std::uint64_t>(degree));
    std::uniform_real_distribution<double> any(-1, 1), decay(0.3, 1);
    std::vector<Polynomial<double>> result(count);
    for (Polynomial<double>& p : result) {
        p.degree = degree;
        const double ratio = decay(random);
        double size = 1;
        for (int k = 0; k <= degree; ++k) {
            p[k] = exact_in_float(size * any(random));
            size *= ratio;
        }
    }
    return result;
}

/** Whether p changes its sign near t, in extended precision. */
bool crosses_near(const Polynomial<double>& p, double t, double distance) {
    Polynomial<long double> exact{p.degree, {}};
    std::copy(p.c.begin(), p.c.end(), exact.c.begin());
    const auto at = [&](double x) {
        return segment::chebyshev_value(exact, static_cast<long double>(std::clamp(x, 0.0, 1.0)));
    };
    return at(t - distance) * at(t + distance) <= 0;
}

double processor_nanoseconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

template <class Solve> Answers timed(const std::vector<Polynomial<double>>& polynomials, const Solve& solve) {
    Answers result;
    result.answers.reserve(polynomials.size());
    const double start = processor_nanoseconds();
    for (const Polynomial<double>& p : polynomials) {
        result.answers.push_back(solve(p));
    }
    result.nanoseconds = (processor_nanoseconds() - start) / static_cast<double>(polynomials.size());
    return result;
}

template <class Real> Answers bernstein_on_cpu(const std::vector<Polynomial<double>>& polynomials) {
    return timed(polynomials, [](const Polynomial<double>& p) {
        Polynomial<Real> chebyshev{p.degree, {}};
        std::transform(p.c.begin(), p.c.end(), chebyshev.c.begin(), [](double c) { return static_cast<Real>(c); });
        const Polynomial<Real> bernstein = segment::to_bernstein(chebyshev);
        const Real error = segment::bernstein_rounding(chebyshev);
        const std::array<Real, 1> zero{};
        segment::Isolation isolation;
        Answer answer;
        while (answer.crossing == no_root && !isolation.is_over()) {
            const auto crossing = segment::next_crossing<Real>(bernstein, error, zero, isolation);
            const bool is_touch = crossing.kind == segment::CrossingKind::touch;
            if (is_touch) {
                answer.touch_from = std::min(answer.touch_from, static_cast<double>(crossing.lower));
                answer.touch_to = static_cast<double>(crossing.upper);
            } else if (crossing.kind != segment::CrossingKind::none) {
                answer.crossing = static_cast<double>(crossing.t);
            }
        }
        return answer;
    });
}

template <class Real>
Answers on_device(const Device& device, const std::vector<Polynomial<double>>& polynomials, bool by_colleague) {
    const int degree = polynomials.front().degree;
    const auto size = static_cast<std::size_t>(degree + 1);
    KernelRequest request;
    request.name = "bench_roots";
    request.kernel = "bench/bench_roots.comp";
    request.precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    request.text = segment::segment_glsl(segment::fixed_plan(degree));
    request.defines = {{"CORE_COLLEAGUE", by_colleague ? "1" : "0"}};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(std::uint32_t);
    const ComposedKernel kernel(device, request);
    std::vector<Real> numbers;
    numbers.reserve(size * polynomials.size());
    for (const Polynomial<double>& p : polynomials) {
        std::transform(p.c.begin(), p.c.begin() + degree + 1, std::back_inserter(numbers),
                       [](double c) { return static_cast<Real>(c); });
    }
    const Buffer input(device, numbers.size() * sizeof(Real)), output(device, n_answer * polynomials.size() * sizeof(Real));
    input.write_items<Real>(numbers);
    const std::array<const Buffer*, 2> bindings{&input, &output};
    const auto run = [&](std::uint32_t count) {
        const DeviceTimer timer(device);
        kernel.dispatch(bindings, std::as_bytes(std::span(&count, 1)), (count + roots_group_size - 1) / roots_group_size);
        return 1e6 * timer.milliseconds() * timer.n_processors();
    };
    // Drivers compile at the first dispatch.
    run(1);
    Answers result;
    result.nanoseconds =
        n_lanes * run(static_cast<std::uint32_t>(polynomials.size())) / static_cast<double>(polynomials.size());
    const std::vector<Real> found = output.read_items<Real>(n_answer * polynomials.size());
    for (std::size_t i = 0; i < polynomials.size(); ++i) {
        const Real* const answer = &found[n_answer * i];
        result.answers.push_back(
            {static_cast<double>(answer[0]), static_cast<double>(answer[1]), static_cast<double>(answer[2])});
    }
    return result;
}

/** Reference: all roots by eigenvalues on the CPU in double precision. */
RootsResult compare(const std::vector<Polynomial<double>>& polynomials, const std::vector<std::vector<double>>& roots,
                    const Answers& bernstein, const Answers& colleague, Precision precision) {
    const double distance = reach(precision);
    RootsResult result;
    result.degree = polynomials.front().degree;
    result.precision = precision;
    result.n_polynomials = polynomials.size();
    result.bernstein_nanoseconds = bernstein.nanoseconds;
    result.colleague_nanoseconds = colleague.nanoseconds;
    for (std::size_t i = 0; i < polynomials.size(); ++i) {
        const Polynomial<double>& p = polynomials[i];
        double first = no_root;
        for (const double root : roots[i]) {
            first = first == no_root && crosses_near(p, root, distance) ? root : first;
        }
        const bool has_root = first != no_root;
        result.n_with_root += has_root ? 1 : 0;
        const Answer &ours = bernstein.answers[i], &theirs = colleague.answers[i];
        const auto has_missed = [&](const Answer& answer) {
            const bool is_touched = answer.touch_from <= first + distance && first - distance <= answer.touch_to;
            return has_root && !(answer.crossing <= first + distance) && !is_touched;
        };
        result.bernstein_missed += has_missed(ours) ? 1 : 0;
        result.colleague_missed += has_missed(theirs) ? 1 : 0;
        result.n_touching += ours.touch_from <= 1 ? 1 : 0;
        const auto is_false = [&](const Answer& answer) {
            return answer.crossing <= 1 && !crosses_near(p, answer.crossing, distance);
        };
        result.bernstein_false += is_false(ours) ? 1 : 0;
        result.colleague_false += is_false(theirs) ? 1 : 0;
        const bool is_earlier = ours.crossing < first - distance && ours.crossing <= 1;
        result.n_earlier += is_earlier && !is_false(ours) ? 1 : 0;
        if (has_root && std::abs(ours.crossing - first) <= distance) {
            result.bernstein_error = std::max(result.bernstein_error, std::abs(ours.crossing - first));
        }
    }
    return result;
}

} // namespace

void bench_roots(const Device* device, std::uint64_t n_polynomials, const std::function<void(const RootsResult&)>& report) {
    constexpr auto n_degrees = static_cast<std::uint64_t>(most_degree - least_degree + 1);
    for (int degree = least_degree; degree <= most_degree; ++degree) {
        const auto polynomials = random_polynomials(degree, (n_polynomials + n_degrees - 1) / n_degrees);
        std::vector<std::vector<double>> roots;
        roots.reserve(polynomials.size());
        const Answers reference = timed(polynomials, [&](const Polynomial<double>& p) {
            roots.push_back(segment::roots_by_colleague(p, 0));
            return Answer{roots.back().empty() ? no_root : roots.back().front()};
        });
        const auto report_as = [&](bool is_device, const Answers& bernstein, const Answers& colleague, Precision precision) {
            RootsResult result = compare(polynomials, roots, bernstein, colleague, precision);
            result.on_device = is_device;
            report(result);
        };
        report_as(false, bernstein_on_cpu<double>(polynomials), reference, Precision::float64);
        report_as(false, bernstein_on_cpu<float>(polynomials), reference, Precision::float32);
        if (device != nullptr) {
            report_as(true, on_device<double>(*device, polynomials, false), on_device<double>(*device, polynomials, true),
                      Precision::float64);
            report_as(true, on_device<float>(*device, polynomials, false), on_device<float>(*device, polynomials, true),
                      Precision::float32);
        }
    }
}

} // namespace elvis
