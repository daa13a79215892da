// Integrators of volume rendering: their orders of convergence, what categories leave out, and what adaptive steps promise.
#include <core/bench/volume/composite_rules.hpp>
#include <core/bench/volume/volume.hpp>
#include <core/bench/volume/volume_convergence.hpp>
#include <core/render/renderer.hpp>
#include <tests/support/device.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

using namespace elvis;

namespace {

constexpr std::uint32_t size = 24;
constexpr FieldRange sphere_range{0, 18};
/** Along rays the field is a quadratic polynomial, which cubics are: errors are far below. */
constexpr double reference_tolerance = 1e-5;

const PluginRegistry& registry() {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    static const PluginRegistry the_registry;
    return the_registry;
}

class Scene {
public:
    Scene(const BenchFolder& folder, const std::string& shape, const std::array<std::uint32_t, 3>& n, Precision precision)
        : m_volume(sphere_volume(registry(), folder, shape, n)), m_renderer(test::device(), m_volume, precision),
          m_request(volume_picture(m_renderer.ranges().bounds(), size)) {
        m_request.volume.emplace();
    }

    VolumeRendering& rendering() { return *m_request.volume; }
    FrameRequest& request() { return m_request; }

    Frame draw(Integrator integrator, double step, double tolerance) {
        rendering().integrator = integrator;
        rendering().step = step;
        rendering().tolerance = tolerance;
        return m_renderer.render(m_request);
    }

    /** Of errors in steps of diagonal / 2^from to diagonal / 2^to. */
    double order(Integrator integrator, const Frame& reference, int from, int to) {
        std::vector<RuleError> errors;
        for (int i = from; i <= to; ++i) {
            const Frame frame = draw(integrator, diagonal / (1 << i), 1e-9);
            CHECK(frame.counts.inexact_volume_pixels == 0);
            errors.push_back({std::size_t{1} << i, 0, largest_difference(frame, reference)});
        }
        return measured_order(errors, 1e-9);
    }

    static constexpr double diagonal = 6.6332495807;

private:
    RuntimeVolume m_volume;
    Renderer m_renderer;
    FrameRequest m_request;
};

} // namespace

TEST_CASE("integrators with steps converge as theory says") {
    const BenchFolder folder("");
    Scene scene(folder, "hexahedron", {1, 1, 1}, Precision::float64);
    scene.rendering().transfer = peaks_in(sphere_range, 0.2, Scene::diagonal);
    const Frame peaks = scene.draw(Integrator::exact, 0, reference_tolerance);
    CHECK(peaks.counts.volume_pixels > 100);
    // At most one breakpoint a step; where it lies in it moves errors by some.
    CHECK(scene.order(Integrator::riemann, peaks, 6, 9) == Approx(1).margin(0.15));
    CHECK(scene.order(Integrator::trapezoid, peaks, 6, 9) == Approx(2).margin(0.3));
    CHECK(scene.order(Integrator::categories, peaks, 6, 9) == Approx(2).margin(0.3));
    scene.rendering().transfer = ramp_in(sphere_range, Scene::diagonal);
    const Frame ramp = scene.draw(Integrator::exact, 0, reference_tolerance);
    CHECK(scene.order(Integrator::riemann, ramp, 4, 8) == Approx(1).margin(0.1));
    CHECK(scene.order(Integrator::trapezoid, ramp, 4, 8) == Approx(2).margin(0.1));
}

TEST_CASE("where all is smooth, Gauss and Kronrod's points are worth more than the trapezoidal rule's") {
    const BenchFolder folder("");
    for (const std::string shape : {"hexahedron", "tetrahedron"}) {
        CAPTURE(shape);
        Scene scene(folder, shape, {4, 4, 6}, Precision::float64);
        scene.rendering().transfer = ramp_in(sphere_range, Scene::diagonal);
        const Frame reference = scene.draw(Integrator::exact, 0, reference_tolerance);
        // Seven points in the longer segments, three in the others.
        const double step = Scene::diagonal / 80;
        const Frame trapezoid = scene.draw(Integrator::trapezoid, step, 1e-9);
        const Frame categories = scene.draw(Integrator::categories, step, 1e-9);
        CHECK(1.3 * largest_difference(categories, reference) < largest_difference(trapezoid, reference));
        CHECK(scene.order(Integrator::categories, reference, 4, 8) > 1.9);
        // Colour zero: no light, but what is behind is dimmed, by Kronrod's rule.
        scene.rendering().transfer.color = {{0, {0, 0, 0}}};
        const Frame dark = scene.draw(Integrator::exact, 0, reference_tolerance);
        CHECK(3 * largest_difference(scene.draw(Integrator::categories, step, 1e-9), dark) <
              largest_difference(scene.draw(Integrator::trapezoid, step, 1e-9), dark));
    }
}

TEST_CASE("categories leave out what is certainly empty, and nothing else") {
    const BenchFolder folder("");
    for (const std::string shape : {"hexahedron", "prism", "pyramid", "tetrahedron"}) {
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            CAPTURE(shape, precision == Precision::float64);
            Scene scene(folder, shape, {4, 4, 6}, precision);
            scene.rendering().transfer = peaks_in(sphere_range, 0.02, Scene::diagonal);
            const double step = Scene::diagonal / 300;
            scene.rendering().skips_by_range = false;
            const Frame trapezoid = scene.draw(Integrator::trapezoid, step, 1e-6);
            const Frame categories = scene.draw(Integrator::categories, step, 1e-6);
            CHECK(trapezoid.counts.volume_pixels > 100);
            const Frame reference =
                scene.draw(Integrator::exact, 0, precision == Precision::float64 ? reference_tolerance : 1e-4);
            // As good, or better in segments beside a peak's breakpoints.
            CHECK(largest_difference(categories, reference) < 1.1 * largest_difference(trapezoid, reference) + 1e-6);
            CHECK(largest_difference(trapezoid, reference) < 0.02);
            CHECK(static_cast<double>(categories.counts.field_evaluations) <
                  0.8 * static_cast<double>(trapezoid.counts.field_evaluations));
            CHECK(reference.counts.work_limit_pixels == 0);
        }
    }
}

TEST_CASE("adaptive steps come to their tolerance or say that they do not") {
    const BenchFolder folder("");
    std::mt19937 random(20121);
    const auto between = [&random](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    for (const std::string shape : {"hexahedron", "pyramid", "tetrahedron"}) {
        const std::array<std::uint32_t, 3> n = shape == "hexahedron" ? std::array{1u, 1u, 1u} : std::array{4u, 4u, 6u};
        Scene scene(folder, shape, n, Precision::float64), single(folder, shape, n, Precision::float32);
        for (int trial = 0; trial < 6; ++trial) {
            const double low = between(0, 6);
            TransferFunction transfer =
                peaks_in({low, low + between(2, 12)}, std::pow(10.0, between(-2, -0.5)), Scene::diagonal);
            scene.rendering().transfer = single.rendering().transfer = transfer;
            const Frame reference = scene.draw(Integrator::exact, 0, reference_tolerance);
            for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
                for (const bool is_single : {false, true}) {
                    const Frame frame = (is_single ? single : scene).draw(Integrator::adaptive_trapezoid, 0, tolerance);
                    CAPTURE(shape, trial, tolerance, is_single);
                    double largest = 0;
                    std::size_t n_flagged = 0;
                    for (std::size_t i = 0; i < frame.color.size(); ++i) {
                        const bool is_flagged = (frame.flags[i / 4] & pixel_flag::volume_tolerance) != 0;
                        n_flagged += is_flagged ? 1 : 0;
                        largest = std::max(largest, is_flagged ? 0 : std::abs(frame.color[i] - reference.color[i]));
                    }
                    CHECK(largest <= tolerance);
                    // At moderate tolerance it does come there, where rounding lets it.
                    CHECK((tolerance < 1e-3 || is_single || n_flagged <= 4 * 4));
                    CHECK(frame.counts.work_limit_pixels == 0);
                }
            }
        }
    }
}

TEST_CASE("steps that would be too many for one element are said to be too few") {
    const BenchFolder folder("");
    Scene scene(folder, "hexahedron", {1, 1, 1}, Precision::float64);
    scene.rendering().transfer = ramp_in(sphere_range, Scene::diagonal);
    for (const Integrator integrator : {Integrator::riemann, Integrator::trapezoid, Integrator::categories}) {
        CAPTURE(name_of(integrator));
        const Frame frame = scene.draw(integrator, 1e-4, 1e-3);
        CHECK(frame.counts.inexact_volume_pixels > 100);
        CHECK(frame.counts.work_limit_pixels == 0);
        CHECK(scene.draw(integrator, 0.01, 1e-3).counts.inexact_volume_pixels == 0);
    }
}

TEST_CASE("convergence is written as tables and plots") {
    const BenchFolder folder("");
    VolumeConvergence result;
    for (const char* figure : {"6.1", "6.3a", "6.8"}) {
        for (const char* curve : {"reference", "trapezoid", "exact"}) {
            for (const double samples : {10.0, 20.0}) {
                ConvergenceRow row;
                row.figure = figure;
                row.scene = "a, b";
                row.curve = curve;
                row.order = static_cast<std::uint32_t>(samples);
                row.samples_a_pixel = samples;
                row.error = 1 / (samples * samples);
                row.units = samples;
                result.rows.push_back(row);
            }
        }
    }
    result.comparison.resize(2);
    write_volume_convergence(folder.path() / "plots", result);
    const auto text_of = [&folder](const char* name) { return test::read_file(folder.path() / "plots" / name); };
    const auto n_lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    const std::string table = text_of("volume-convergence.csv");
    CHECK(n_lines(table) == 19);
    CHECK(table.find("6.3a,\"a, b\",\"exact\"") != std::string::npos);
    CHECK(n_lines(text_of("volume-comparison.csv")) == 3);
    for (const char* name : {"composite-rules.svg", "sphere-peaks.svg", "time-by-order.svg"}) {
        CAPTURE(name);
        const std::string plot = text_of(name);
        CHECK(plot.find("trapezoid") != std::string::npos);
        CHECK(plot.find("reference") == std::string::npos);
    }
    // Nothing to draw.
    CHECK_FALSE(std::filesystem::exists(folder.path() / "plots" / "volume-peaks.svg"));
}

TEST_CASE("integrators are known by name") {
    for (const Integrator integrator : {Integrator::riemann, Integrator::trapezoid, Integrator::categories,
                                        Integrator::adaptive_trapezoid, Integrator::exact}) {
        CHECK(integrator_of(name_of(integrator)) == integrator);
    }
    CHECK_THROWS_WITH(integrator_of("simpson"), Catch::Contains("adaptive-trapezoid"));
}
