#include <core/bench/volume/volume_convergence.hpp>

#include <core/bench/volume/composite_rules.hpp>
#include <core/bench/volume/integrator_comparison.hpp>
#include <core/bench/volume/volume.hpp>
#include <core/render/renderer.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

/** Smaller differences are those of the reference. */
constexpr double least_error = 1e-8;
constexpr double reference_tolerance = ConvergenceScene::reference_tolerance;
constexpr double wanted_error = ConvergenceScene::wanted_error;

constexpr std::array<Integrator, 3> stepped{Integrator::riemann, Integrator::trapezoid, Integrator::categories};
constexpr std::array<Integrator, 2> tolerant{Integrator::adaptive_trapezoid, Integrator::exact};

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

/** Over the finer half of what is not yet rounding; `errors` by intervals. */
double finer_order(std::vector<RuleError> errors, double least) {
    std::erase_if(errors, [least](const RuleError& error) { return error.error < least; });
    return measured_order(std::span(errors).subspan(errors.size() / 2), least);
}

class ConvergenceBench {
public:
    ConvergenceBench(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                     const VolumeConvergenceOptions& options, double unit_nanoseconds, const VolumeConvergenceReport& report)
        : m_device(device), m_registry(registry), m_folder(folder), m_options(options), m_unit(unit_nanoseconds),
          m_report(report) {}

    VolumeConvergence result;

    /** Figure 6.1: a function of one variable. */
    void integrate_broken_cubic() {
        // Not powers of two: 0.54 lies at another place in its interval each time.
        std::vector<std::size_t> n_intervals;
        for (double n = 2; n < 3000; n *= 1.3) {
            n_intervals.push_back(static_cast<std::size_t>(n) + (n_intervals.size() < 3 ? n_intervals.size() : 0));
        }
        for (const CompositeRule rule : composite_rules) {
            const std::vector<RuleError> errors =
                rule_errors(rule, BrokenCubic::value, 0, 1, BrokenCubic::integral(1), n_intervals);
            for (const RuleError& error : errors) {
                ConvergenceRow row;
                row.figure = "6.1";
                row.scene = "function 6.29";
                row.curve = name_of(rule);
                row.step = 1 / static_cast<double>(error.n_intervals);
                row.samples_a_pixel = static_cast<double>(error.n_samples);
                row.error = error.error;
                add(row);
            }
            add_order("6.1", "function 6.29", name_of(rule), measured_order(errors, 1e-13, 4));
        }
    }

    /** Figure 6.2: two breakpoints close together. Small elements, so that steps may be short. */
    void draw_edges() {
        const RuntimeVolume volume = sphere_volume(m_registry, m_folder, "hexahedron", {16, 16, 24});
        ConvergenceScene scene(m_device, volume, Precision::float64, m_options.size);
        for (const double width : {0.2, 0.02, 0.002}) {
            scene.rendering().transfer = edge_at(4, width);
            double tolerance = 0;
            const Frame reference = scene.draw_reference(tolerance);
            vary_step(scene, reference, "6.2", "sphere", Integrator::trapezoid, "w = " + text_of(width), 5, 14);
        }
    }

    /** Figure 6.3: peaks, and a transfer function that is smooth, in one hexahedron. */
    void draw_sphere() {
        const RuntimeVolume volume = sphere_volume(m_registry, m_folder, "hexahedron", {1, 1, 1});
        ConvergenceScene scene(m_device, volume, Precision::float64, m_options.size);
        scene.rendering().transfer = peaks_in(scene.range(), 0.1, scene.diagonal());
        vary_all(scene, "6.3a", "sphere, peaks");
        scene.rendering().transfer = ramp_in(scene.range(), scene.diagonal());
        vary_all(scene, "6.3b", "sphere, ramp");
    }

    void draw_volume() {
        const RuntimeVolume volume(m_registry.runtime_for(m_options.volume), m_options.volume);
        ConvergenceScene scene(m_device, volume, Precision::float64, m_options.size);
        scene.rendering().transfer = peaks_in(scene.usual_range(), 0.24, scene.diagonal());
        vary_all(scene, "6.3c", "volume, peaks");
    }

    /** Figures 6.6 to 6.8. */
    void time_waves() {
        const std::uint32_t order = m_options.orders[m_options.orders.size() / 2];
        for (const std::uint32_t other : m_options.orders) {
            const RuntimeVolume volume = waves_volume(m_registry, m_folder, m_options.elements_a_side, other);
            Renderer renderer(m_device, volume, Precision::float32);
            const auto measure = [&](const char* figure, Integrator integrator, std::uint32_t size, double step,
                                     double tolerance) {
                FrameRequest request = waves_volume_picture(size, BenchTransfer::prototype, integrator);
                request.volume->step = step;
                request.volume->tolerance = tolerance;
                renderer.render(request);
                const Frame frame = renderer.render(request);
                ConvergenceRow row = row_of(frame, figure, "waves", name_of(integrator), size, frame.counts.volume_pixels);
                row.step = is_stepped(integrator) ? step : 0;
                row.tolerance = tolerance;
                row.order = other;
                add(row);
            };
            constexpr double length = 3.8;
            for (const Integrator integrator : {Integrator::trapezoid, Integrator::categories, Integrator::exact}) {
                measure("6.8", integrator, m_options.time_size, length / 128, wanted_error);
                if (other != order) {
                    continue;
                }
                for (const std::uint32_t part : {2u, 1u}) {
                    measure("6.7", integrator, m_options.time_size / part, length / 128, wanted_error);
                }
                measure("6.7", integrator, 2 * m_options.time_size, length / 128, wanted_error);
                for (int i = 0; i < 5; ++i) {
                    measure("6.6", integrator, m_options.time_size, length / (16 << i), 0.1 * std::pow(10.0, -i));
                }
            }
        }
    }

    void compare() {
        const auto compare_in = [&](const std::string& name, const RuntimeVolume& volume) {
            compare_integrators(m_device, name, volume, m_options.time_size, m_unit, [&](const ComparisonRow& row) {
                result.comparison.push_back(row);
                m_report.comparison(row);
            });
        };
        compare_in("sphere", sphere_volume(m_registry, m_folder, "hexahedron", {4, 4, 6}));
        if (!m_options.volume.empty()) {
            compare_in("volume", RuntimeVolume(m_registry.runtime_for(m_options.volume), m_options.volume));
        }
        compare_in("ball", generated_volume(m_registry, m_folder, "mixed-ball",
                                            R"({"generator":1,"mesh":"ball","shape":"mixed","elements":[3,3,3],"layers":2,)"
                                            R"("geometry_order":2,"order":6,"field":"waves"})"));
    }

private:
    static bool is_stepped(Integrator integrator) {
        return std::find(stepped.begin(), stepped.end(), integrator) != stepped.end();
    }

    void add(ConvergenceRow row) {
        row.units = 1e6 * row.milliseconds / m_unit;
        result.rows.push_back(row);
        m_report.row(row);
    }

    void add_order(const std::string& figure, const std::string& scene, const std::string& curve, double order) {
        result.orders.push_back({figure, scene, curve, order});
        m_report.order(result.orders.back());
    }

    static ConvergenceRow row_of(const Frame& frame, const std::string& figure, const std::string& scene,
                                 const std::string& curve, std::uint32_t size, std::uint64_t n_pixels) {
        ConvergenceRow row;
        row.figure = figure;
        row.scene = scene;
        row.curve = curve;
        row.size = size;
        row.samples_a_pixel = a_pixel(frame.counts.field_evaluations, n_pixels);
        row.inexact_share = a_pixel(frame.counts.inexact_volume_pixels, n_pixels);
        row.milliseconds = frame.device_milliseconds;
        return row;
    }

    /** Steps of the diagonal over 2^from to 2^to; to the end of those that are short enough for loops. */
    void vary_step(ConvergenceScene& scene, const Frame& reference, const std::string& figure, const std::string& name,
                   Integrator integrator, const std::string& curve, int from, int to) {
        std::vector<RuleError> errors;
        for (int i = from; i <= to; ++i) {
            const double step = scene.diagonal() / static_cast<double>(1 << i);
            if (i == from) {
                scene.draw(integrator, step, reference_tolerance);
            }
            const Frame frame = scene.draw(integrator, step, reference_tolerance);
            ConvergenceRow row = row_of(frame, figure, name, curve, scene.request().width, scene.n_pixels());
            row.step = step;
            row.error = largest_difference(frame, reference);
            if (row.inexact_share > 0) {
                break;
            }
            add(row);
            errors.push_back({std::size_t{1} << i, 0, row.error});
        }
        add_order(figure, name, curve, finer_order(errors, least_error));
    }

    void vary_all(ConvergenceScene& scene, const std::string& figure, const std::string& name) {
        double reference_tolerance_reached = 0;
        const Frame reference = scene.draw_reference(reference_tolerance_reached);
        ConvergenceRow row = row_of(reference, figure, name, "reference", scene.request().width, scene.n_pixels());
        row.tolerance = reference_tolerance_reached;
        add(row);
        for (const Integrator integrator : stepped) {
            vary_step(scene, reference, figure, name, integrator, name_of(integrator), 3, 15);
        }
        for (const Integrator integrator : tolerant) {
            scene.draw(integrator, 0, 0.1);
            for (int digits = 1; digits <= (integrator == Integrator::exact ? 7 : 5); ++digits) {
                const double tolerance = std::pow(10.0, -digits);
                const Frame frame = scene.draw(integrator, 0, tolerance);
                row = row_of(frame, figure, name, name_of(integrator), scene.request().width, scene.n_pixels());
                row.tolerance = tolerance;
                row.error = largest_difference(frame, reference);
                add(row);
            }
        }
    }

    const Device& m_device;
    const PluginRegistry& m_registry;
    const BenchFolder& m_folder;
    const VolumeConvergenceOptions& m_options;
    double m_unit;
    const VolumeConvergenceReport& m_report;
};

} // namespace

VolumeConvergence bench_volume_convergence(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                           const VolumeConvergenceOptions& options, double unit_nanoseconds,
                                           const VolumeConvergenceReport& report) {
    ConvergenceBench bench(device, registry, folder, options, unit_nanoseconds, report);
    bench.integrate_broken_cubic();
    bench.draw_edges();
    bench.draw_sphere();
    if (!options.volume.empty()) {
        bench.draw_volume();
    }
    bench.time_waves();
    bench.compare();
    return bench.result;
}

} // namespace elvis
