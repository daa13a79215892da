// The tables and plots of the suite volume-convergence.
#include <core/bench/volume/volume_convergence.hpp>

#include <core/base/error.hpp>
#include <core/bench/plot.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

namespace elvis {

namespace {

void check(std::ofstream& file, const std::filesystem::path& path) {
    file.close();
    if (!file) {
        throw Error(path.string(), "cannot be written");
    }
}

void write_rows(const std::filesystem::path& path, const VolumeConvergence& result) {
    std::ofstream file(path);
    file << "figure,scene,curve,step,tolerance,order,size,samples_a_pixel,milliseconds,units,error,inexact_share\n";
    for (const ConvergenceRow& row : result.rows) {
        file << row.figure << ",\"" << row.scene << "\",\"" << row.curve << "\"," << row.step << ',' << row.tolerance << ','
             << row.order << ',' << row.size << ',' << row.samples_a_pixel << ',' << row.milliseconds << ',' << row.units << ','
             << row.error << ',' << row.inexact_share << '\n';
    }
    check(file, path);
}

void write_comparison(const std::filesystem::path& path, const VolumeConvergence& result) {
    std::ofstream file(path);
    file << "scene,transfer,integrator,step,tolerance,is_missed,error,samples_a_pixel,milliseconds,units,inexact_share,fewer_"
            "samples,"
            "less_time\n";
    for (const ComparisonRow& row : result.comparison) {
        file << row.scene << ',' << row.transfer << ',' << row.curve << ',' << row.step << ',' << row.tolerance << ','
             << row.is_missed << ',' << row.error << ',' << row.samples_a_pixel << ',' << row.milliseconds << ',' << row.units
             << ',' << row.inexact_share << ',' << row.fewer_samples << ',' << row.less_time << '\n';
    }
    check(file, path);
}

using ConvergenceNumber = std::function<double(const ConvergenceRow&)>;

/** A line a curve, in the order in which their names first come. */
std::vector<PlotSeries> lines(const VolumeConvergence& result, const std::string& figure, const ConvergenceNumber& x,
                              const ConvergenceNumber& y) {
    std::map<std::string, std::size_t> index;
    std::vector<PlotSeries> series;
    for (const ConvergenceRow& row : result.rows) {
        if (row.figure != figure || row.curve == "reference") {
            continue;
        }
        const auto [position, is_new] = index.try_emplace(row.curve, series.size());
        if (is_new) {
            series.push_back({row.curve, {}});
        }
        series[position->second].points.push_back({x(row), y(row)});
    }
    for (PlotSeries& line : series) {
        std::sort(line.points.begin(), line.points.end());
    }
    return series;
}

} // namespace

void write_volume_convergence(const std::filesystem::path& folder, const VolumeConvergence& result) {
    std::filesystem::create_directories(folder);
    write_rows(folder / "volume-convergence.csv", result);
    write_comparison(folder / "volume-comparison.csv", result);
    const ConvergenceNumber samples = [](const ConvergenceRow& row) { return row.samples_a_pixel; };
    const ConvergenceNumber error = [](const ConvergenceRow& row) { return row.error; };
    const ConvergenceNumber units = [](const ConvergenceRow& row) { return row.units; };
    const ConvergenceNumber size = [](const ConvergenceRow& row) { return static_cast<double>(row.size); };
    const ConvergenceNumber order = [](const ConvergenceRow& row) { return static_cast<double>(row.order); };
    const PlotAxis samples_axis{"samples a pixel", true}, error_axis{"largest error", true}, time{"time / U", true};
    const auto draw = [&](const char* name, const char* title, const char* figure, const PlotAxis& x_axis,
                          const ConvergenceNumber& x, const PlotAxis& y_axis, const ConvergenceNumber& y) {
        const std::vector<PlotSeries> series = lines(result, figure, x, y);
        if (!series.empty()) {
            write_svg(folder / (std::string(name) + ".svg"), {title, x_axis, y_axis, series});
        }
    };
    draw("composite-rules", "One breakpoint (6.1)", "6.1", {"samples", true}, samples, error_axis, error);
    draw("close-breakpoints", "Two breakpoints (6.2)", "6.2", samples_axis, samples, error_axis, error);
    draw("sphere-peaks", "Sphere, three peaks (6.3a)", "6.3a", samples_axis, samples, error_axis, error);
    draw("sphere-ramp", "Sphere, smooth (6.3b)", "6.3b", samples_axis, samples, error_axis, error);
    draw("volume-peaks", "Volume, three peaks (6.3)", "6.3c", samples_axis, samples, error_axis, error);
    draw("volume-peaks-time", "Volume, three peaks", "6.3c", time, units, error_axis, error);
    draw("time-by-samples", "Time by samples (6.6)", "6.6", {"samples a pixel", false}, samples, {"time / U", false}, units);
    draw("time-by-size", "Time by size of the picture (6.7)", "6.7", {"side of the picture (pixels)", true}, size, time, units);
    draw("time-by-order", "Time by order of the field (6.8)", "6.8", {"order of the field", false}, order, time, units);
}

} // namespace elvis
