// elvis_volume_accuracy: volumes drawn by the program against the oracle's pictures, printed. See --help.
#include "volume_accuracy.hpp"
#include <tests/support/test_volumes.hpp>

#include <core/scene/output/png_file.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <map>
#include <optional>

namespace elvis::oracle {
namespace {

struct Arguments {
    std::string scene = "sphere", transfer, device, oracle_png;
    std::uint64_t count = 100, seed = 0;
    std::vector<std::string> precisions{"float32", "float64"};
    std::string integrator = "exact";
    VolumeSettings settings;
    bool is_json = false;
};

const std::map<std::string, Integrator> integrators{{"riemann", Integrator::riemann},
                                                    {"trapezoid", Integrator::trapezoid},
                                                    {"categories", Integrator::categories},
                                                    {"adaptive_trapezoid", Integrator::adaptive_trapezoid},
                                                    {"exact", Integrator::exact}};

nlohmann::json to_json(const VolumeComparison& c, const FrameCounts& counts, double milliseconds) {
    return {{"pixels", c.n_pixels},
            {"touched", c.n_touched},
            {"error", c.error},
            {"flagged_error", c.flagged_error},
            {"mean_error", c.mean_error},
            {"worst_pixel", c.worst_pixel},
            {"worst_channel", c.worst_channel},
            {"flagged", c.n_flagged},
            {"above", c.n_above},
            {"above_flagged", c.n_above_flagged},
            {"above_rounding", c.n_above_rounding},
            {"wrong", c.n_wrong},
            {"oracle_error", c.oracle_error},
            {"evaluations_per_pixel",
             static_cast<double>(counts.field_evaluations) / static_cast<double>(std::max<std::uint64_t>(counts.pixels, 1))},
            {"segments", counts.volume_segments},
            {"empty_segments", counts.empty_segments},
            {"steps", counts.volume_steps},
            {"breakpoints", counts.volume_breakpoints},
            {"milliseconds", milliseconds}};
}

void write_oracle_png(const VolumePicture& picture, const VolumeScene& scene, std::uint32_t size, const std::string& path) {
    Frame frame;
    frame.width = frame.height = size;
    frame.color.assign(std::size_t{4} * size * size, 1);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Color color = color_over(picture.answers[i], scene.background);
        std::copy(color.begin(), color.end(), frame.color.begin() + static_cast<std::ptrdiff_t>(4 * picture.pixels[i]));
    }
    write_png(frame, path, 8);
}

class Tool {
public:
    explicit Tool(Arguments arguments) : m_arguments(std::move(arguments)) {
        VolumeSettings& settings = m_arguments.settings;
        settings.integrator = integrators.at(m_arguments.integrator);
        settings.precisions.clear();
        for (const std::string& name : m_arguments.precisions)
            if (name != "none")
                settings.precisions.push_back(name == "float64" ? Precision::float64 : Precision::float32);
        if (!settings.precisions.empty())
            m_device.emplace(m_arguments.device);
        m_sums.resize(settings.precisions.size());
        m_evaluations.resize(settings.precisions.size());
        m_pixels.resize(settings.precisions.size());
        m_milliseconds.resize(settings.precisions.size());
    }

    int run() {
        if (m_arguments.scene == "sphere") {
            const TemporaryFile file("sphere.h5");
            for (const double width : {0.1, 0.01}) {
                add(sphere_scene("hexahedron", true, width, file.path()), -1);
                for (const char* shape : {"hexahedron", "prism", "pyramid", "tetrahedron"})
                    add(sphere_scene(shape, false, width, file.path()), -1);
            }
        } else if (m_arguments.scene == "random") {
            const TemporaryFile file("random.h5");
            for (std::uint64_t seed = m_arguments.seed; seed < m_arguments.seed + m_arguments.count; ++seed) {
                VolumeScene scene = random_scene(seed, file.path());
                if (!m_arguments.transfer.empty()) {
                    scene.transfer = read_transfer(m_arguments.transfer);
                }
                add(scene, static_cast<std::int64_t>(seed));
            }
        } else {
            add(file_scene(m_arguments.scene,
                           m_arguments.transfer.empty() ? TransferFunction{} : read_transfer(m_arguments.transfer)),
                -1);
        }
        return report();
    }

private:
    void add(const VolumeScene& scene, std::int64_t seed) {
        const VolumeAccuracy one = measure_volume(m_device ? &*m_device : nullptr, scene, m_arguments.settings);
        if (!m_arguments.oracle_png.empty() && m_n_scenes == 0)
            write_oracle_png(one.exact, scene, m_arguments.settings.size, m_arguments.oracle_png);
        ++m_n_scenes;
        m_oracle_seconds += one.exact.seconds;
        m_oracle_failures += one.exact.n_failures;
        m_oracle_rays += one.exact.pixels.size();
        for (const VolumeLight& light : one.exact.answers) {
            m_oracle_error = std::max(m_oracle_error, light.error);
            m_oracle_pieces += light.n_smooth_intervals;
            m_oracle_touched += light.transmittance < 1;
        }
        nlohmann::json row{{"scene", scene.description}};
        if (seed >= 0)
            row["seed"] = seed;
        for (std::size_t i = 0; i < one.comparisons.size(); ++i) {
            const VolumeComparison& comparison = one.comparisons[i];
            const char* precision = name_of(m_arguments.settings.precisions[i]);
            row[precision] = to_json(comparison, one.counts[i], one.render_milliseconds[i]);
            // Of many scenes only the bad ones.
            if (!m_arguments.is_json && (seed < 0 || comparison.n_wrong > 0)) {
                std::printf("%s%s: %s: error %.3g, mean %.3g; %zu above, %zu flagged, %zu by rounding, %zu wrong; pixel %zu; "
                            "%.4g evaluations "
                            "a pixel\n",
                            seed < 0 ? "" : ("seed " + std::to_string(seed) + ", ").c_str(), precision,
                            scene.description.c_str(), comparison.error, comparison.mean_error, comparison.n_above,
                            comparison.n_above_flagged, comparison.n_above_rounding, comparison.n_wrong, comparison.worst_pixel,
                            static_cast<double>(one.counts[i].field_evaluations) / static_cast<double>(one.counts[i].pixels));
                std::fflush(stdout);
            }
            m_sums[i] += comparison;
            m_evaluations[i] += one.counts[i].field_evaluations;
            m_pixels[i] += one.counts[i].pixels;
            m_milliseconds[i] += one.render_milliseconds[i];
        }
        m_rows.push_back(std::move(row));
    }

    int report() const {
        bool is_good = m_oracle_failures == 0;
        for (const VolumeComparison& sum : m_sums)
            is_good = is_good && sum.n_wrong == 0;
        if (m_arguments.is_json) {
            const nlohmann::json all{{"scenes", m_rows},
                                     {"integrator", m_arguments.integrator},
                                     {"tolerance", m_arguments.settings.tolerance},
                                     {"step", m_arguments.settings.step},
                                     {"size", m_arguments.settings.size},
                                     {"oracle",
                                      {{"rays", m_oracle_rays},
                                       {"seconds", m_oracle_seconds},
                                       {"failures", m_oracle_failures},
                                       {"error", m_oracle_error}}},
                                     {"good", is_good}};
            std::printf("%s\n", all.dump(1).c_str());
            return is_good ? 0 : 1;
        }
        for (std::size_t i = 0; i < m_sums.size(); ++i)
            std::printf("%s, %zu scenes, %.3g ms and %.4g evaluations a pixel: %s\n%s\n",
                        name_of(m_arguments.settings.precisions[i]), m_n_scenes,
                        m_milliseconds[i] / static_cast<double>(m_pixels[i]),
                        static_cast<double>(m_evaluations[i]) / static_cast<double>(m_pixels[i]),
                        m_sums[i].n_wrong == 0 ? "good" : "WRONG", to_text(m_sums[i]).c_str());
        std::printf(
            "oracle: %.3g rays a second, %zu of %zu with light of a volume, %.3g pieces each, estimate %.2g, %llu failures\n",
            static_cast<double>(m_oracle_rays) / m_oracle_seconds, m_oracle_touched, m_oracle_rays,
            static_cast<double>(m_oracle_pieces) / static_cast<double>(std::max<std::size_t>(m_oracle_touched, 1)),
            m_oracle_error, static_cast<unsigned long long>(m_oracle_failures));
        return is_good ? 0 : 1;
    }

    Arguments m_arguments;
    std::optional<Device> m_device;
    std::vector<VolumeComparison> m_sums;
    std::vector<std::uint64_t> m_evaluations, m_pixels;
    std::vector<double> m_milliseconds;
    nlohmann::json m_rows = nlohmann::json::array();
    std::size_t m_n_scenes = 0, m_oracle_rays = 0, m_oracle_touched = 0, m_oracle_pieces = 0;
    double m_oracle_seconds = 0, m_oracle_error = 0;
    std::uint64_t m_oracle_failures = 0;
};

} // namespace
} // namespace elvis::oracle

int main(int argc, char** argv) {
    elvis::oracle::Arguments arguments;
    CLI::App app("Volumes drawn by ElVis, compared with the oracle channel by channel. Fails if a pixel is off by more than "
                 "the tolerance, "
                 "does not say so, and a field within its rounding would not explain it.");
    std::vector<std::string> integrators;
    for (const auto& [name, integrator] : elvis::oracle::integrators)
        integrators.push_back(name);
    elvis::oracle::VolumeSettings& settings = arguments.settings;
    app.add_option("--scene", arguments.scene, "sphere (three peaks in x^2 + y^2 + z^2), random, or a native volume (.h5)");
    app.add_option("--transfer", arguments.transfer, "Transfer function of random or native volumes, as JSON");
    app.add_option("--count", arguments.count, "Number of random volumes")->check(CLI::PositiveNumber);
    app.add_option("--seed", arguments.seed, "Of the first random volume; the others follow");
    app.add_option("--size", settings.size, "Side of the pictures in pixels")->check(CLI::PositiveNumber);
    app.add_option("--pixels", settings.n_pixels, "Pixels compared in each picture, chosen by chance; 0: all");
    app.add_option("--precision", arguments.precisions, "float32, float64 or both; none: the oracle alone")
        ->check(CLI::IsMember({"float32", "float64", "none"}));
    app.add_option("--integrator", arguments.integrator, "How the integral is found")->check(CLI::IsMember(integrators));
    app.add_option("--tolerance", settings.tolerance, "Of a channel, asked for and allowed");
    app.add_option("--step", settings.step, "Of integrators with steps, over the volume's diagonal");
    app.add_option("--device", arguments.device, "Device by name or index");
    app.add_option("--oracle-png", arguments.oracle_png, "Writes the oracle's picture of the first scene");
    app.add_flag("--json", arguments.is_json, "For machines");
    CLI11_PARSE(app, argc, argv);
    try {
        return elvis::oracle::Tool(arguments).run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis_volume_accuracy: %s\n", error.what());
        return 1;
    }
}
