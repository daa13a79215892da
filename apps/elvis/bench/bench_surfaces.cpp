#include "bench_suites.hpp"

#include <core/bench/interface.hpp>
#include <core/bench/projection.hpp>
#include <core/bench/surfaces.hpp>

namespace elvis::commands {

namespace {

nlohmann::ordered_json to_json(const SurfaceResult& result) {
    return {{"elements_a_side", result.elements_a_side},
            {"order", result.order},
            {"size", result.size},
            {"milliseconds", result.milliseconds},
            {"wall_milliseconds", result.wall_milliseconds},
            {"evaluations_a_pixel", result.evaluations_a_pixel},
            {"newton_steps_a_pixel", result.newton_steps_a_pixel},
            {"estimated_share", result.estimated_share},
            {"undecided_share", result.undecided_share},
            {"field_bytes", result.memory.field_bytes},
            {"geometry_bytes", result.memory.geometry_bytes},
            {"hierarchy_bytes", result.memory.hierarchy_bytes},
            {"field_overhead", result.field_overhead},
            {"geometry_overhead", result.geometry_overhead},
            {"hierarchy_bytes_an_element", result.hierarchy_bytes_an_element}};
}

} // namespace

nlohmann::ordered_json run_surface(const Bench& bench, BenchView view) {
    const BenchArguments& arguments = bench.arguments;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_surface(bench.device, bench.registry, bench.folder, view, arguments.elements, arguments.orders, arguments.sizes,
                  [&](const SurfaceResult& result) {
                      list.push_back(to_json(result));
                      say(arguments,
                          "%2u^3  p%-2u %4u^2  %8.1f ms %9.3g U   wall %7.1f ms   a pixel: %.2f values, %.2f "
                          "steps   bytes: field x %.2f, geometry x %.2f, hierarchy %.0f an element\n",
                          result.elements_a_side, result.order, result.size, result.milliseconds,
                          1e6 * result.milliseconds / bench.unit, result.wall_milliseconds, result.evaluations_a_pixel,
                          result.newton_steps_a_pixel, result.field_overhead, result.geometry_overhead,
                          result.hierarchy_bytes_an_element);
                  });
    return list;
}

nlohmann::ordered_json run_surfaces(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    SurfacesOptions options;
    if (arguments.names_elements) {
        options.elements = arguments.elements;
        options.elements_a_side = options.contour_elements_a_side = arguments.elements.front();
    }
    if (arguments.names_orders) {
        options.orders = options.contour_orders = arguments.orders;
        options.order = arguments.orders.front();
    }
    if (arguments.names_sizes) {
        options.sizes = arguments.sizes;
        options.size = arguments.sizes.front();
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const auto report = [&](const SurfacesRow& row) {
        list.push_back({{"series", row.series},
                        {"surface", row.surface},
                        {"n_elements", row.n_elements},
                        {"order", row.order},
                        {"size", row.size},
                        {"subdivisions", row.subdivisions},
                        {"precision", name_of(row.precision)},
                        {"milliseconds", row.milliseconds},
                        {"wall_milliseconds", row.wall_milliseconds},
                        {"units", row.units},
                        {"hit_pixels", row.hit_pixels},
                        {"contour_pixels", row.contour_pixels},
                        {"undecided_contour_pixels", row.undecided_pixels},
                        {"field_bytes", row.memory.field_bytes},
                        {"geometry_bytes", row.memory.geometry_bytes},
                        {"hierarchy_bytes", row.memory.hierarchy_bytes},
                        {"device_bytes", row.device_bytes}});
        say(arguments,
            "by %-12s %-18s %6llu elements p%-2u %4u^2 limit %u %s  %8.1f ms %9.3g U  %6.1f MB  %7llu contour pixels, "
            "%llu undecided\n",
            row.series.c_str(), row.surface.c_str(), static_cast<unsigned long long>(row.n_elements), row.order, row.size,
            row.subdivisions, name_of(row.precision), row.milliseconds, row.units, 1e-6 * static_cast<double>(row.device_bytes),
            static_cast<unsigned long long>(row.contour_pixels), static_cast<unsigned long long>(row.undecided_pixels));
    };
    const std::vector<SurfacesRow> rows =
        bench_surfaces(bench.device, bench.registry, bench.folder, options, bench.unit, report);
    if (!arguments.output.empty()) {
        write_surfaces(arguments.output, rows);
    }
    return list;
}

nlohmann::ordered_json run_projection(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    ProjectionOptions options;
    options.volume = arguments.volume;
    options.isovalue = arguments.isovalue;
    options.elements_a_side = arguments.names_elements ? arguments.elements.front() : options.elements_a_side;
    options.order = arguments.names_orders ? arguments.orders.front() : options.order;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::vector<ProjectionRow> rows =
        bench_projection(bench.device, bench.registry, bench.folder, options, [&](const ProjectionRow& row) {
            list.push_back({{"method", name_of(row.method)},
                            {"degree", row.degree},
                            {"mean_degree", row.mean_degree},
                            {"evaluations_a_segment", row.evaluations_a_segment},
                            {"segments", row.n_segments},
                            {"verified_segments", row.n_verified},
                            {"certified_segments", row.n_certified},
                            {"projected_pixels", row.n_projected_pixels},
                            {"hit_pixels", row.n_hits},
                            {"missing_pixels", row.n_missing},
                            {"other_pixels", row.n_other},
                            {"undecided_pixels", row.n_undecided},
                            {"mean_depth_error", row.mean_depth_error},
                            {"largest_depth_error", row.largest_depth_error},
                            {"mean_normal_error", row.mean_normal_error},
                            {"largest_normal_error", row.largest_normal_error},
                            {"milliseconds", row.milliseconds}});
            say(arguments,
                "%-9s degree %2u (mean %4.1f)  %5.1f evaluations a segment  %6llu hits, %llu missing, %llu other, %llu "
                "undecided  depth %.1e (%.1e)  normal %.1e (%.1e)  %8.1f ms\n",
                name_of(row.method), row.degree, row.mean_degree, row.evaluations_a_segment,
                static_cast<unsigned long long>(row.n_hits), static_cast<unsigned long long>(row.n_missing),
                static_cast<unsigned long long>(row.n_other), static_cast<unsigned long long>(row.n_undecided),
                row.mean_depth_error, row.largest_depth_error, row.mean_normal_error, row.largest_normal_error,
                row.milliseconds);
        });
    if (!arguments.output.empty()) {
        write_projection(arguments.output, rows);
    }
    return list;
}

nlohmann::ordered_json run_interface(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    InterfaceOptions options;
    options.volume = arguments.volume;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    const InterfaceResult result = bench_interface(bench.device, bench.registry, bench.folder, options);
    const double of_least = result.plugin.least / result.by_hand.least;
    const auto time = [](const InterfaceResult::Time& of) {
        return nlohmann::ordered_json{{"least", of.least}, {"median", of.median}};
    };
    say(bench.arguments,
        "%llu elements, %s, %u^2, %llu pixels: plugin %.2f ms (median %.2f), by hand %.2f ms (median %.2f); plugin over by "
        "hand %.3f, of "
        "the least %.3f\n"
        "%llu pixels show other elements, values differ by %.1e of their range; Newton steps %llu and %llu\n",
        static_cast<unsigned long long>(result.n_elements), result.field.c_str(), result.size,
        static_cast<unsigned long long>(result.hit_pixels), result.plugin.least, result.plugin.median, result.by_hand.least,
        result.by_hand.median, result.ratio, of_least, static_cast<unsigned long long>(result.other_pixels),
        result.largest_difference, static_cast<unsigned long long>(result.plugin_newton_steps),
        static_cast<unsigned long long>(result.by_hand_newton_steps));
    return {{"n_elements", result.n_elements},
            {"field", result.field},
            {"size", result.size},
            {"hit_pixels", result.hit_pixels},
            {"plugin_milliseconds", time(result.plugin)},
            {"by_hand_milliseconds", time(result.by_hand)},
            {"ratio", result.ratio},
            {"ratio_of_least", of_least},
            {"other_pixels", result.other_pixels},
            {"largest_difference", result.largest_difference},
            {"newton_steps", {{"plugin", result.plugin_newton_steps}, {"by_hand", result.by_hand_newton_steps}}}};
}

} // namespace elvis::commands
