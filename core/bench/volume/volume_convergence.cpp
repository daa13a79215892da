#include <core/bench/volume/volume_convergence.hpp>

#include <core/base/bounds.hpp>
#include <core/bench/volume/composite_rules.hpp>
#include <core/bench/volume/volume.hpp>
#include <core/render/renderer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace elvis {

namespace {

/** Of references, in double precision; and of samples of integrators that only have steps, so that these are all of their
 * error. */
constexpr double reference_tolerance = 1e-9;
constexpr double largest_reference_tolerance = 1e-5;
/** Smaller differences are those of the reference. */
constexpr double least_error = 1e-8;
/** What the comparison asks for: 8-bit colours, with room. */
constexpr double wanted_error = 1e-3;
constexpr double largest_tolerance = 0.25;

constexpr std::array<Integrator, 3> stepped{Integrator::riemann, Integrator::trapezoid, Integrator::categories};
constexpr std::array<Integrator, 2> tolerant{Integrator::adaptive_trapezoid, Integrator::exact};

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

/** Of what a plane through the middle shows all but the least and the greatest fiftieth: where something is seen of the volume.
 */
FieldRange usual_range(Renderer& renderer) {
    const std::array<double, 6> bounds = renderer.ranges().bounds();
    FrameRequest request = volume_picture(bounds, 64);
    Surface surface;
    const Vector3 normal{0.2, 0.9, 0.1};
    double offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        offset -= 0.5 * normal[axis] * (bounds[axis] + bounds[axis + 3]);
    }
    surface.geometry = CutPlane{{normal[0], normal[1], normal[2], offset}};
    surface.colors.points = {{0, {1, 1, 1}}};
    request.surfaces = {surface};
    std::vector<double> values = renderer.render(request).value;
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) {
        return renderer.ranges().range({}, 0);
    }
    std::sort(values.begin(), values.end());
    return {values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
}

/** A volume in one precision with one transfer function, drawn in many ways. */
class Scene {
public:
    Scene(const Device& device, const RuntimeVolume& volume, Precision precision, std::uint32_t size)
        : m_renderer(device, volume, precision), m_request(volume_picture(m_renderer.ranges().bounds(), size)),
          m_diagonal(diagonal_of(m_renderer.ranges().bounds())), m_range(m_renderer.ranges().range({}, 0)),
          m_usual_range(usual_range(m_renderer)) {
        m_request.volume.emplace();
        rendering().transfer = {{{0, 0.1 / m_diagonal}}, {{0, {1, 1, 1}}}};
        m_n_pixels = draw(Integrator::trapezoid, m_diagonal, wanted_error).counts.volume_pixels;
    }

    /** Pixels of rays that meet the volume. */
    std::uint64_t n_pixels() const { return m_n_pixels; }

    double diagonal() const { return m_diagonal; }
    const FieldRange& range() const { return m_range; }
    const FieldRange& usual_range_of_field() const { return m_usual_range; }
    FrameRequest& request() { return m_request; }

    /** Peaks each 1 % of the field's range wide, where there is something to see of them. */
    TransferFunction narrow_peaks() const {
        const double usual = m_usual_range.upper - m_usual_range.lower;
        return peaks_in(m_usual_range, std::min(0.01 * (m_range.upper - m_range.lower) / usual, 0.24), m_diagonal);
    }
    VolumeRendering& rendering() { return *m_request.volume; }

    Frame draw(Integrator integrator, double step, double tolerance) {
        rendering().integrator = integrator;
        rendering().step = step;
        rendering().tolerance = tolerance;
        return m_renderer.render(m_request);
    }

    /** As exact as loops of drivers allow; `tolerance` is what that was. */
    Frame draw_reference(double& tolerance) {
        tolerance = reference_tolerance;
        Frame frame = draw(Integrator::exact, 0, tolerance);
        while (frame.counts.work_limit_pixels > 0 && tolerance < largest_reference_tolerance) {
            tolerance *= 10;
            frame = draw(Integrator::exact, 0, tolerance);
        }
        return frame;
    }

private:
    Renderer m_renderer;
    FrameRequest m_request;
    double m_diagonal;
    FieldRange m_range, m_usual_range;
    std::uint64_t m_n_pixels = 0;
};

double a_pixel(std::uint64_t count, std::uint64_t n_pixels) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(n_pixels, 1));
}

/** Over the finer half of what is not yet rounding; `errors` by intervals. */
double finer_order(std::vector<RuleError> errors, double least) {
    std::erase_if(errors, [least](const RuleError& error) { return error.error < least; });
    return measured_order(std::span(errors).subspan(errors.size() / 2), least);
}

class Bench {
public:
    Bench(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
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
        Scene scene(m_device, volume, Precision::float64, m_options.size);
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
        Scene scene(m_device, volume, Precision::float64, m_options.size);
        scene.rendering().transfer = peaks_in(scene.range(), 0.1, scene.diagonal());
        vary_all(scene, "6.3a", "sphere, peaks");
        scene.rendering().transfer = ramp_in(scene.range(), scene.diagonal());
        vary_all(scene, "6.3b", "sphere, ramp");
    }

    void draw_volume() {
        const RuntimeVolume volume(m_registry.runtime_for(m_options.volume), m_options.volume);
        Scene scene(m_device, volume, Precision::float64, m_options.size);
        scene.rendering().transfer = peaks_in(scene.usual_range_of_field(), 0.24, scene.diagonal());
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
    void vary_step(Scene& scene, const Frame& reference, const std::string& figure, const std::string& name,
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

    void vary_all(Scene& scene, const std::string& figure, const std::string& name) {
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

    void compare_in(const std::string& name, const RuntimeVolume& volume) {
        Scene exact(m_device, volume, Precision::float64, m_options.time_size);
        Scene scene(m_device, volume, Precision::float32, m_options.time_size);
        for (const bool has_peaks : {true, false}) {
            const TransferFunction transfer = has_peaks ? scene.narrow_peaks() : ramp_in(scene.range(), scene.diagonal());
            exact.rendering().transfer = scene.rendering().transfer = transfer;
            double tolerance = 0;
            const Frame reference = exact.draw_reference(tolerance);
            std::vector<Contender> contenders{exact_contender(wanted_error),
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
                    row.milliseconds = std::min(
                        row.milliseconds, scene.draw(contender.integrator, row.step, tolerance_of(row)).device_milliseconds);
                }
            }
            for (const Contender& contender : contenders) {
                rows.push_back(contender.row);
                rows.back().units = 1e6 * rows.back().milliseconds / m_unit;
            }
            const double samples = std::min(rows[2].samples_a_pixel, rows[3].samples_a_pixel);
            const double time = std::min(rows[2].milliseconds, rows[3].milliseconds);
            for (ComparisonRow& row : rows) {
                row.fewer_samples = samples / row.samples_a_pixel;
                row.less_time = time / row.milliseconds;
                result.comparison.push_back(row);
                m_report.comparison(row);
            }
        }
    }

    static constexpr int coarsest = 2, finest = 13;
    static constexpr int n_timed_runs = 5;

    /** An integrator as it reaches the error that is wanted. */
    struct Contender {
        Integrator integrator = Integrator::exact;
        ComparisonRow row;
    };

    static double tolerance_of(const ComparisonRow& row) { return row.tolerance > 0 ? row.tolerance : wanted_error; }

    static Contender exact_contender(double tolerance) {
        Contender contender;
        contender.row.tolerance = tolerance;
        return contender;
    }

    static Contender stepped_contender(Scene& scene, const Frame& reference, Integrator integrator) {
        const std::optional<double> step = largest_step(scene, reference, integrator);
        Contender contender{integrator, {}};
        contender.row.is_missed = !step;
        contender.row.step = step.value_or(scene.diagonal() / (1 << finest));
        return contender;
    }

    /** Tolerances are kept with much to spare: as steps are, this one is what reaches the error. */
    static double loosest_tolerance(Scene& scene, const Frame& reference) {
        double tolerance = wanted_error;
        while (tolerance < largest_tolerance &&
               largest_difference(scene.draw(Integrator::exact, 0, 2 * tolerance), reference) <= wanted_error) {
            tolerance *= 2;
        }
        return tolerance;
    }

    /** By halving, then by bisection to a quarter of a halving. */
    static std::optional<double> largest_step(Scene& scene, const Frame& reference, Integrator integrator) {
        const auto is_good = [&](double exponent) {
            const Frame frame = scene.draw(integrator, scene.diagonal() * std::exp2(-exponent), wanted_error);
            return largest_difference(frame, reference) <= wanted_error;
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

    const Device& m_device;
    const PluginRegistry& m_registry;
    const BenchFolder& m_folder;
    const VolumeConvergenceOptions& m_options;
    double m_unit;
    const VolumeConvergenceReport& m_report;
};

} // namespace

TransferFunction peaks_in(const FieldRange& range, double width, double diagonal) {
    const double all = range.upper - range.lower;
    TransferFunction transfer;
    for (const double at : {0.25, 0.5, 0.75}) {
        const double middle = range.lower + at * all;
        transfer.density.push_back({middle - 0.5 * width * all, 0});
        // A ray that crosses the range over half the diagonal is in a peak for width / 2 of that; tents are half as dense.
        transfer.density.push_back({middle, 1.2 / (width * diagonal)});
        transfer.density.push_back({middle + 0.5 * width * all, 0});
    }
    transfer.color = {{range.lower + 0.25 * all, {0.2, 0.3, 0.9}},
                      {range.lower + 0.5 * all, {0.9, 0.9, 0.3}},
                      {range.lower + 0.75 * all, {0.8, 0.1, 0.1}}};
    return transfer;
}

TransferFunction ramp_in(const FieldRange& range, double diagonal) {
    // What ranges in elements are certain to hold is more than the field takes.
    const double margin = range.upper - range.lower;
    return {{{range.lower - margin, 0}, {range.upper + margin, 6 / diagonal}},
            {{range.lower - margin, {0.2, 0.3, 0.9}}, {range.upper + margin, {0.8, 0.1, 0.1}}}};
}

TransferFunction edge_at(double value, double width) { return {{{value, 0}, {value + width, 1}}, {{value, {0.9, 0.6, 0.2}}}}; }

FrameRequest volume_picture(const std::array<double, 6>& bounds, std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    const double diagonal = diagonal_of(bounds);
    const Vector3 from_centre = {0.93, 0.72, 0.76};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        request.camera.look_at[axis] = 0.5 * (bounds[axis] + bounds[axis + 3]);
        request.camera.eye[axis] = request.camera.look_at[axis] + diagonal * from_centre[axis];
    }
    request.camera.up = {0.1, 0.2, 1};
    request.camera.field_of_view = 35;
    request.background = {0.1, 0.2, 0.3, 1};
    return request;
}

double largest_difference(const Frame& frame, const Frame& reference) {
    double largest = 0;
    for (std::size_t i = 0; i < frame.color.size(); ++i) {
        if ((reference.flags[i / 4] & pixel_flag::work_limit) != 0) {
            continue;
        }
        const double off = std::abs(frame.color[i] - reference.color[i]);
        if (std::isnan(off)) {
            return std::numeric_limits<double>::infinity();
        }
        largest = std::max(largest, off);
    }
    return largest;
}

RuntimeVolume sphere_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& shape,
                            const std::array<std::uint32_t, 3>& n) {
    const std::string x = std::to_string(n[0]), y = std::to_string(n[1]), z = std::to_string(n[2]);
    std::string name = "sphere-";
    name += shape + "-" + x + "-" + y + "-" + z;
    std::string text =
        R"({"generator":1,"mesh":"box","box":[[-1,-1,-2],[1,1,4]],"order":2,"geometry_order":1,"field":"sphere","shape":")";
    text += shape + R"(","elements":[)" + x + "," + y + "," + z + "]}";
    return generated_volume(registry, folder, name, text);
}

VolumeConvergence bench_volume_convergence(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                           const VolumeConvergenceOptions& options, double unit_nanoseconds,
                                           const VolumeConvergenceReport& report) {
    Bench bench(device, registry, folder, options, unit_nanoseconds, report);
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
