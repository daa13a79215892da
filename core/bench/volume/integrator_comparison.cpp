#include <core/bench/volume/integrator_comparison.hpp>

#include <core/bench/volume/volume.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace elvis {

namespace {

constexpr double largest_tolerance = 0.25;
constexpr int coarsest = 2, finest = 13;
constexpr int n_timed_runs = 5;

/** An integrator as it reaches the error that is wanted. */
struct Contender {
    Integrator integrator = Integrator::exact;
    ComparisonRow row;
};

double tolerance_of(const ComparisonRow& row) { return row.tolerance > 0 ? row.tolerance : ConvergenceScene::wanted_error; }

Contender exact_contender(double tolerance) {
    Contender contender;
    contender.row.tolerance = tolerance;
    return contender;
}

/** By halving, then by bisection to a quarter of a halving. */
std::optional<double> largest_step(ConvergenceScene& scene, const Frame& reference, Integrator integrator) {
    const auto is_good = [&](double exponent) {
        const Frame frame = scene.draw(integrator, scene.diagonal() * std::exp2(-exponent), ConvergenceScene::wanted_error);
        return largest_difference(frame, reference) <= ConvergenceScene::wanted_error;
    };
    double good = coarsest;
    while (!is_good(good)) {
        good += 1;
        if (good > finest) {
            return std::nullopt;
        }
    }
    double bad = good - 1;
    while (good > coarsest && good - bad > 0.25) {
        const double middle = 0.5 * (good + bad);
        (is_good(middle) ? good : bad) = middle;
    }
    return scene.diagonal() * std::exp2(-good);
}

Contender stepped_contender(ConvergenceScene& scene, const Frame& reference, Integrator integrator) {
    const std::optional<double> step = largest_step(scene, reference, integrator);
    Contender contender{integrator, {}};
    contender.row.is_missed = !step;
    contender.row.step = step.value_or(scene.diagonal() / (1 << finest));
    return contender;
}

/** Tolerances are kept with much to spare: as steps are, this one is what reaches the error. */
double loosest_tolerance(ConvergenceScene& scene, const Frame& reference) {
    double tolerance = ConvergenceScene::wanted_error;
    while (tolerance < largest_tolerance &&
           largest_difference(scene.draw(Integrator::exact, 0, 2 * tolerance), reference) <= ConvergenceScene::wanted_error) {
        tolerance *= 2;
    }
    return tolerance;
}

} // namespace

void compare_integrators(const Device& device, const std::string& name, const RuntimeVolume& volume, std::uint32_t size,
                         double unit_nanoseconds, const std::function<void(const ComparisonRow&)>& report) {
    ConvergenceScene exact(device, volume, Precision::float64, size);
    ConvergenceScene scene(device, volume, Precision::float32, size);
    for (const bool has_peaks : {true, false}) {
        const TransferFunction transfer = has_peaks ? scene.narrow_peaks() : ramp_in(scene.range(), scene.diagonal());
        exact.rendering().transfer = scene.rendering().transfer = transfer;
        double tolerance = 0;
        const Frame reference = exact.draw_reference(tolerance);
        std::vector<Contender> contenders{exact_contender(ConvergenceScene::wanted_error),
                                          exact_contender(loosest_tolerance(scene, reference)),
                                          stepped_contender(scene, reference, Integrator::trapezoid),
                                          stepped_contender(scene, reference, Integrator::categories)};
        std::vector<ComparisonRow> rows;
        for (Contender& contender : contenders) {
            const Frame frame = scene.draw(contender.integrator, contender.row.step, tolerance_of(contender.row));
            ComparisonRow& row = contender.row;
            row.scene = name;
            row.transfer = has_peaks ? "peaks" : "ramp";
            row.curve = name_of(contender.integrator);
            row.error = largest_difference(frame, reference);
            row.samples_a_pixel = a_pixel(frame.counts.field_evaluations, scene.n_pixels());
            row.inexact_share = a_pixel(frame.counts.inexact_volume_pixels, scene.n_pixels());
            row.milliseconds = std::numeric_limits<double>::infinity();
        }
        // In turn, so that what else the machine does meets all of them.
        for (int run = 0; run < n_timed_runs; ++run) {
            for (Contender& contender : contenders) {
                ComparisonRow& row = contender.row;
                row.milliseconds = std::min(row.milliseconds,
                                            scene.draw(contender.integrator, row.step, tolerance_of(row)).device_milliseconds);
            }
        }
        for (const Contender& contender : contenders) {
            rows.push_back(contender.row);
            rows.back().units = 1e6 * rows.back().milliseconds / unit_nanoseconds;
        }
        const double samples = std::min(rows[2].samples_a_pixel, rows[3].samples_a_pixel);
        const double time = std::min(rows[2].milliseconds, rows[3].milliseconds);
        for (ComparisonRow& row : rows) {
            row.fewer_samples = samples / row.samples_a_pixel;
            row.less_time = time / row.milliseconds;
            report(row);
        }
    }
}

} // namespace elvis
