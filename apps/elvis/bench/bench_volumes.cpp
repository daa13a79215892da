#include "bench_suites.hpp"

#include <core/base/error.hpp>
#include <core/bench/combined.hpp>
#include <core/bench/four_pictures.hpp>
#include <core/bench/volume/volume.hpp>
#include <core/bench/volume/volume_convergence.hpp>

namespace elvis::commands {

nlohmann::ordered_json run_volume(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    std::vector<Integrator> integrators;
    for (const std::string& name : arguments.integrators) {
        integrators.push_back(integrator_of(name));
    }
    const std::vector<std::uint32_t> sizes = arguments.names_sizes ? arguments.sizes : std::vector<std::uint32_t>{512};
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_volume(bench.device, bench.registry, bench.folder, integrators, arguments.elements, arguments.orders, sizes,
                 [&](const VolumeResult& result) {
                     list.push_back({{"transfer", name_of(result.transfer)},
                                     {"integrator", name_of(result.integrator)},
                                     {"elements_a_side", result.elements_a_side},
                                     {"order", result.order},
                                     {"size", result.size},
                                     {"milliseconds", result.milliseconds},
                                     {"wall_milliseconds", result.wall_milliseconds},
                                     {"evaluations_a_pixel", result.evaluations_a_pixel},
                                     {"mappings_a_pixel", result.mappings_a_pixel},
                                     {"segments_a_pixel", result.segments_a_pixel},
                                     {"empty_segments_a_pixel", result.empty_segments_a_pixel},
                                     {"steps_a_pixel", result.steps_a_pixel},
                                     {"breakpoints_a_pixel", result.breakpoints_a_pixel},
                                     {"inexact_share", result.inexact_share}});
                     say(arguments,
                         "%-9s %-18s %2u^3  p%-2u %4u^2  %8.1f ms %9.3g U   a pixel: %.1f values, %.1f "
                         "mappings, "
                         "%.1f segments (%.1f empty), %.1f steps, %.1f breakpoints; inexact %.4f\n",
                         name_of(result.transfer), name_of(result.integrator), result.elements_a_side, result.order,
                         result.size, result.milliseconds, 1e6 * result.milliseconds / bench.unit, result.evaluations_a_pixel,
                         result.mappings_a_pixel, result.segments_a_pixel, result.empty_segments_a_pixel, result.steps_a_pixel,
                         result.breakpoints_a_pixel, result.inexact_share);
                 });
    return list;
}

nlohmann::ordered_json run_combined(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::uint32_t size = arguments.names_sizes ? arguments.sizes.front() : 1024;
    bench_combined(
        bench.device, bench.registry, bench.folder, arguments.volume, arguments.isovalue, size, [&](const CombinedRow& row) {
            list.push_back({{"name", row.name},
                            {"milliseconds", row.milliseconds},
                            {"wall_milliseconds", row.wall_milliseconds},
                            {"field_evaluations", row.counts.field_evaluations},
                            {"volume_segments", row.counts.volume_segments},
                            {"hidden_pixels", row.counts.hidden_pixels},
                            {"spared_pixels", row.counts.spared_pixels},
                            {"difference", row.difference}});
            say(arguments,
                "%-24s %8.1f ms  wall %8.1f ms  %9llu values  %9llu segments  %8llu pixels hidden  %9llu spared  off by %.1e\n",
                row.name.c_str(), row.milliseconds, row.wall_milliseconds,
                static_cast<unsigned long long>(row.counts.field_evaluations),
                static_cast<unsigned long long>(row.counts.volume_segments),
                static_cast<unsigned long long>(row.counts.hidden_pixels),
                static_cast<unsigned long long>(row.counts.spared_pixels), row.difference);
        });
    return list;
}

nlohmann::ordered_json run_mfem(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    if (arguments.volume.empty()) {
        throw Error("elvis bench mfem", "it draws a volume of your own: name it with --volume FILE");
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::uint32_t size = arguments.names_sizes ? arguments.sizes.front() : 1024;
    bench_four_pictures(bench.device, bench.registry, arguments.volume, size, [&](const PictureRow& row) {
        const FrameCounts& counts = row.counts;
        list.push_back({{"name", row.name},
                        {"size", row.size},
                        {"milliseconds", row.milliseconds},
                        {"wall_milliseconds", row.wall_milliseconds},
                        {"covered_pixels", row.covered_pixels},
                        {"field_evaluations", counts.field_evaluations},
                        {"mapping_evaluations", counts.mapping_evaluations},
                        {"newton_iterations", counts.newton_iterations},
                        {"volume_segments", counts.volume_segments},
                        {"volume_steps", counts.volume_steps},
                        {"volume_breakpoints", counts.volume_breakpoints},
                        {"undecided_pixels", counts.undecided_pixels},
                        {"estimated_pixels", counts.estimated_pixels}});
        say(arguments,
            "%-10s %4u^2  %8.1f ms  wall %8.1f ms  %7llu pixels covered  %9llu values  %9llu segments  %9llu breakpoints\n",
            row.name.c_str(), row.size, row.milliseconds, row.wall_milliseconds,
            static_cast<unsigned long long>(row.covered_pixels), static_cast<unsigned long long>(counts.field_evaluations),
            static_cast<unsigned long long>(counts.volume_segments),
            static_cast<unsigned long long>(counts.volume_breakpoints));
    });
    return list;
}

namespace {

nlohmann::ordered_json to_json(const ConvergenceRow& row) {
    return {{"figure", row.figure},
            {"scene", row.scene},
            {"curve", row.curve},
            {"step", row.step},
            {"tolerance", row.tolerance},
            {"order", row.order},
            {"size", row.size},
            {"samples_a_pixel", row.samples_a_pixel},
            {"milliseconds", row.milliseconds},
            {"error", row.error},
            {"inexact_share", row.inexact_share}};
}

nlohmann::ordered_json to_json(const ComparisonRow& row) {
    return {{"scene", row.scene},
            {"transfer", row.transfer},
            {"integrator", row.curve},
            {"step", row.step},
            {"tolerance", row.tolerance},
            {"is_missed", row.is_missed},
            {"error", row.error},
            {"samples_a_pixel", row.samples_a_pixel},
            {"milliseconds", row.milliseconds},
            {"inexact_share", row.inexact_share},
            {"fewer_samples", row.fewer_samples},
            {"less_time", row.less_time}};
}

} // namespace

nlohmann::ordered_json run_volume_convergence(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    VolumeConvergenceOptions options;
    options.volume = arguments.volume;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    options.time_size = arguments.names_sizes ? arguments.sizes.back() : options.time_size;
    options.orders = arguments.names_orders ? arguments.orders : options.orders;
    options.elements_a_side = arguments.names_elements ? arguments.elements.front() : options.elements_a_side;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array(), orders = rows, comparison = rows;
    VolumeConvergenceReport report;
    report.row = [&](const ConvergenceRow& row) {
        rows.push_back(to_json(row));
        if (row.figure != "6.1") {
            say(arguments,
                "%-4s %-14s %-18s step %-9.3g tolerance %-7.1g p%-2u %4u^2  %8.1f samples a pixel %9.1f ms  error %.3g, "
                "inexact %.4f\n",
                row.figure.c_str(), row.scene.c_str(), row.curve.c_str(), row.step, row.tolerance, row.order, row.size,
                row.samples_a_pixel, row.milliseconds, row.error, row.inexact_share);
        }
    };
    report.order = [&](const ConvergenceOrder& order) {
        orders.push_back({{"figure", order.figure}, {"scene", order.scene}, {"curve", order.curve}, {"order", order.order}});
        say(arguments, "%-4s %-14s %-18s order %.2f\n", order.figure.c_str(), order.scene.c_str(), order.curve.c_str(),
            order.order);
    };
    report.comparison = [&](const ComparisonRow& row) {
        comparison.push_back(to_json(row));
        say(arguments,
            "to 0.001: %-7s %-6s %-11s %s %-9.3g error %-9.3g%s %8.1f samples a pixel (%.2f times fewer) %9.1f ms (%.2f times "
            "less), inexact %.4f\n",
            row.scene.c_str(), row.transfer.c_str(), row.curve.c_str(), row.step > 0 ? "step" : "tol.",
            row.step > 0 ? row.step : row.tolerance, row.error, row.is_missed ? " MISSED" : "", row.samples_a_pixel,
            row.fewer_samples, row.milliseconds, row.less_time, row.inexact_share);
    };
    const VolumeConvergence result =
        bench_volume_convergence(bench.device, bench.registry, bench.folder, options, bench.unit, report);
    if (!arguments.output.empty()) {
        write_volume_convergence(arguments.output, result);
    }
    return {{"rows", rows}, {"orders", orders}, {"comparison", comparison}};
}

} // namespace elvis::commands
