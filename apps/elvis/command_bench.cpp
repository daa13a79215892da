#include "commands.hpp"

#include <core/base/error.hpp>
#include <core/bench/bench.hpp>
#include <core/bench/combined.hpp>
#include <core/bench/projection.hpp>
#include <core/bench/roots.hpp>
#include <core/bench/surfaces.hpp>
#include <core/bench/volume.hpp>
#include <core/bench/volume_convergence.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace elvis::commands {

namespace {

struct Arguments {
    std::string suite;
    std::string device;
    std::string data;
    std::vector<std::uint32_t> elements{16, 32};
    std::vector<std::uint32_t> orders{3, 6, 8};
    std::vector<std::uint32_t> sizes{512, 1024};
    /** Which of these the user has named, for the suite that has other defaults. */
    bool names_elements = false, names_orders = false, names_sizes = false;
    std::uint64_t n_jacobians = 1000000;
    std::uint64_t n_polynomials = 1000000;
    std::string output;
    std::string volume;
    std::optional<double> isovalue;
    std::vector<std::string> integrators{"exact"};
    bool json = false;
};

nlohmann::ordered_json to_json(const SurfaceResult& result) {
    return {{"elements_a_side", result.elements_a_side},
            {"order", result.order},
            {"size", result.size},
            {"milliseconds", result.milliseconds},
            {"wall_milliseconds", result.wall_milliseconds},
            {"ratio_to_prototype", result.ratio_to_prototype},
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

void print(const SurfaceResult& result, double unit) {
    std::printf("%2u^3  p%-2u %4u^2  %8.1f ms %9.3g U  %5.2f of the prototype   wall %7.1f ms   a pixel: %.2f values, %.2f "
                "steps   bytes: field x %.2f, geometry x %.2f, hierarchy %.0f an element\n",
                result.elements_a_side, result.order, result.size, result.milliseconds, 1e6 * result.milliseconds / unit,
                result.ratio_to_prototype, result.wall_milliseconds, result.evaluations_a_pixel, result.newton_steps_a_pixel,
                result.field_overhead, result.geometry_overhead, result.hierarchy_bytes_an_element);
    std::fflush(stdout);
}

/** Smooth, and disturbed so much that many elements need the determinant's own form, and that many are negative. */
constexpr double jacobian_disturbances[] = {0, 0.1, 0.2, 0.4};

nlohmann::ordered_json run_jacobian(const Arguments& arguments) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const std::uint32_t order : {1u, 2u}) {
        for (const double disturbance : jacobian_disturbances) {
            const JacobianResult result = bench_jacobian(arguments.n_jacobians, order, disturbance);
            list.push_back({{"n_elements", result.n_elements},
                            {"geometry_order", result.geometry_order},
                            {"disturbance", result.disturbance},
                            {"elements_a_second_a_core", result.elements_a_second},
                            {"n_negative", result.n_negative},
                            {"n_undecided", result.n_undecided}});
            if (!arguments.json) {
                std::printf(
                    "Jacobians of %llu hexahedra of geometry order %u, nodes disturbed by %.2f: %9.0f elements a second a "
                    "core, %llu negative, %llu undecided\n",
                    static_cast<unsigned long long>(result.n_elements), result.geometry_order, result.disturbance,
                    result.elements_a_second, static_cast<unsigned long long>(result.n_negative),
                    static_cast<unsigned long long>(result.n_undecided));
                std::fflush(stdout);
            }
        }
    }
    return list;
}

nlohmann::ordered_json run_roots(const Arguments& arguments) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const Device device(arguments.device);
    if (!arguments.json) {
        std::printf("First roots on [0, 1] of %llu random polynomials, by the Bernstein form and by the colleague matrix\n"
                    "times in ns: of a core, for 8 polynomials on the device, for one on the CPU\n",
                    static_cast<unsigned long long>(arguments.n_polynomials));
    }
    bench_roots(&device, arguments.n_polynomials, [&](const RootsResult& result) {
        const char* const precision = result.precision == Precision::float64 ? "float64" : "float32";
        const char* const place = result.on_device ? "device" : "cpu";
        list.push_back({{"degree", result.degree},
                        {"place", place},
                        {"precision", precision},
                        {"n_polynomials", result.n_polynomials},
                        {"n_with_root", result.n_with_root},
                        {"bernstein_missed", result.bernstein_missed},
                        {"colleague_missed", result.colleague_missed},
                        {"n_earlier", result.n_earlier},
                        {"bernstein_false", result.bernstein_false},
                        {"colleague_false", result.colleague_false},
                        {"n_touching", result.n_touching},
                        {"bernstein_error", result.bernstein_error},
                        {"bernstein_nanoseconds", result.bernstein_nanoseconds},
                        {"colleague_nanoseconds", result.colleague_nanoseconds}});
        if (!arguments.json) {
            std::printf(
                "degree %2d %-6s %s  %6llu of %6llu have a root; missed %llu and %llu, false %llu and %llu, earlier %llu, "
                "touching %4llu; error %.1e; %6.0f and %6.0f ns\n",
                result.degree, place, precision, static_cast<unsigned long long>(result.n_with_root),
                static_cast<unsigned long long>(result.n_polynomials), static_cast<unsigned long long>(result.bernstein_missed),
                static_cast<unsigned long long>(result.colleague_missed),
                static_cast<unsigned long long>(result.bernstein_false),
                static_cast<unsigned long long>(result.colleague_false), static_cast<unsigned long long>(result.n_earlier),
                static_cast<unsigned long long>(result.n_touching), result.bernstein_error, result.bernstein_nanoseconds,
                result.colleague_nanoseconds);
            std::fflush(stdout);
        }
    });
    return list;
}

nlohmann::ordered_json run_surfaces(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                    const BenchFolder& folder, double unit) {
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
                        {"precision", row.precision == Precision::float64 ? "float64" : "float32"},
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
        if (!arguments.json) {
            std::printf(
                "by %-12s %-18s %6llu elements p%-2u %4u^2 limit %u %s  %8.1f ms %9.3g U  %6.1f MB  %7llu contour pixels, "
                "%llu undecided\n",
                row.series.c_str(), row.surface.c_str(), static_cast<unsigned long long>(row.n_elements), row.order, row.size,
                row.subdivisions, row.precision == Precision::float64 ? "float64" : "float32", row.milliseconds, row.units,
                1e-6 * static_cast<double>(row.device_bytes), static_cast<unsigned long long>(row.contour_pixels),
                static_cast<unsigned long long>(row.undecided_pixels));
            std::fflush(stdout);
        }
    };
    const std::vector<SurfacesRow> rows = bench_surfaces(device, registry, folder, options, unit, report);
    if (!arguments.output.empty()) {
        write_surfaces(arguments.output, rows);
    }
    return list;
}

nlohmann::ordered_json run_segments(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                    const BenchFolder& folder, double unit) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_segments(device, registry, folder, arguments.elements, arguments.sizes, [&](const SegmentsResult& result) {
        const char* precision = result.precision == Precision::float64 ? "float64" : "float32";
        list.push_back({{"elements_a_side", result.elements_a_side},
                        {"size", result.size},
                        {"precision", precision},
                        {"milliseconds", result.milliseconds},
                        {"n_segments", result.n_segments},
                        {"evaluations_a_segment", result.evaluations_a_segment},
                        {"turns_a_segment", result.turns_a_segment},
                        {"n_overlaps", result.n_overlaps},
                        {"n_failures", result.n_failures},
                        {"n_breaks", result.n_breaks}});
        if (!arguments.json) {
            std::printf("%2u^3  %4u^2  %s  %8.1f ms %9.3g U   %llu segments, each %.2f evaluations, %.2f turns; %llu overlaps, "
                        "%llu failures, %llu chains broken\n",
                        result.elements_a_side, result.size, precision, result.milliseconds, 1e6 * result.milliseconds / unit,
                        static_cast<unsigned long long>(result.n_segments), result.evaluations_a_segment,
                        result.turns_a_segment, static_cast<unsigned long long>(result.n_overlaps),
                        static_cast<unsigned long long>(result.n_failures), static_cast<unsigned long long>(result.n_breaks));
            std::fflush(stdout);
        }
    });
    return list;
}

nlohmann::ordered_json run_volume(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                  const BenchFolder& folder, double unit) {
    std::vector<Integrator> integrators;
    for (const std::string& name : arguments.integrators) {
        integrators.push_back(integrator_of(name));
    }
    const std::vector<std::uint32_t> sizes = arguments.names_sizes ? arguments.sizes : std::vector<std::uint32_t>{512};
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_volume(device, registry, folder, integrators, arguments.elements, arguments.orders, sizes, unit,
                 [&](const VolumeResult& result) {
        list.push_back({{"transfer", name_of(result.transfer)},
                        {"integrator", name_of(result.integrator)},
                        {"elements_a_side", result.elements_a_side},
                        {"order", result.order},
                        {"size", result.size},
                        {"milliseconds", result.milliseconds},
                        {"wall_milliseconds", result.wall_milliseconds},
                        {"ratio_to_prototype", result.ratio_to_prototype},
                        {"evaluations_a_pixel", result.evaluations_a_pixel},
                        {"mappings_a_pixel", result.mappings_a_pixel},
                        {"segments_a_pixel", result.segments_a_pixel},
                        {"empty_segments_a_pixel", result.empty_segments_a_pixel},
                        {"steps_a_pixel", result.steps_a_pixel},
                        {"breakpoints_a_pixel", result.breakpoints_a_pixel},
                        {"inexact_share", result.inexact_share}});
        if (!arguments.json) {
            std::printf("%-9s %-18s %2u^3  p%-2u %4u^2  %8.1f ms %9.3g U  %5.2f of the prototype   a pixel: %.1f values, %.1f mappings, "
                        "%.1f segments (%.1f empty), %.1f steps, %.1f breakpoints; inexact %.4f\n",
                        name_of(result.transfer), name_of(result.integrator), result.elements_a_side, result.order, result.size,
                        result.milliseconds, 1e6 * result.milliseconds / unit, result.ratio_to_prototype, result.evaluations_a_pixel,
                        result.mappings_a_pixel, result.segments_a_pixel, result.empty_segments_a_pixel, result.steps_a_pixel,
                        result.breakpoints_a_pixel, result.inexact_share);
            std::fflush(stdout);
        }
    });
    return list;
}

nlohmann::ordered_json run_volume_convergence(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                              const BenchFolder& folder, double unit) {
    VolumeConvergenceOptions options;
    options.volume = arguments.volume;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    options.time_size = arguments.names_sizes ? arguments.sizes.back() : options.time_size;
    options.orders = arguments.names_orders ? arguments.orders : options.orders;
    options.elements_a_side = arguments.names_elements ? arguments.elements.front() : options.elements_a_side;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array(), orders = rows, comparison = rows;
    VolumeConvergenceReport report;
    report.row = [&](const ConvergenceRow& row) {
        rows.push_back({{"figure", row.figure},
                        {"scene", row.scene},
                        {"curve", row.curve},
                        {"step", row.step},
                        {"tolerance", row.tolerance},
                        {"order", row.order},
                        {"size", row.size},
                        {"samples_a_pixel", row.samples_a_pixel},
                        {"milliseconds", row.milliseconds},
                        {"error", row.error},
                        {"inexact_share", row.inexact_share}});
        if (!arguments.json && row.figure != "6.1") {
            std::printf("%-4s %-14s %-18s step %-9.3g tolerance %-7.1g p%-2u %4u^2  %8.1f samples a pixel %9.1f ms  error %.3g, inexact %.4f\n",
                        row.figure.c_str(), row.scene.c_str(), row.curve.c_str(), row.step, row.tolerance, row.order, row.size,
                        row.samples_a_pixel, row.milliseconds, row.error, row.inexact_share);
            std::fflush(stdout);
        }
    };
    report.order = [&](const ConvergenceOrder& order) {
        orders.push_back({{"figure", order.figure}, {"scene", order.scene}, {"curve", order.curve}, {"order", order.order}});
        if (!arguments.json) {
            std::printf("%-4s %-14s %-18s order %.2f\n", order.figure.c_str(), order.scene.c_str(), order.curve.c_str(), order.order);
            std::fflush(stdout);
        }
    };
    report.comparison = [&](const ComparisonRow& row) {
        comparison.push_back({{"scene", row.scene},
                              {"transfer", row.transfer},
                              {"integrator", row.curve},
                              {"step", row.step},
                              {"is_missed", row.is_missed},
                              {"error", row.error},
                              {"samples_a_pixel", row.samples_a_pixel},
                              {"milliseconds", row.milliseconds},
                              {"inexact_share", row.inexact_share},
                              {"fewer_samples", row.fewer_samples},
                              {"less_time", row.less_time}});
        if (!arguments.json) {
            std::printf("to 0.001: %-7s %-6s %-11s step %-9.3g error %-9.3g%s %8.1f samples a pixel (%.2f times fewer) %9.1f ms (%.2f times "
                        "less), inexact %.4f\n",
                        row.scene.c_str(), row.transfer.c_str(), row.curve.c_str(), row.step, row.error,
                        row.is_missed ? " MISSED" : "", row.samples_a_pixel, row.fewer_samples, row.milliseconds, row.less_time,
                        row.inexact_share);
            std::fflush(stdout);
        }
    };
    const VolumeConvergence result = bench_volume_convergence(device, registry, folder, options, unit, report);
    if (!arguments.output.empty()) {
        write_volume_convergence(arguments.output, result);
    }
    return {{"rows", rows}, {"orders", orders}, {"comparison", comparison}};
}

nlohmann::ordered_json run_projection(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                      const BenchFolder& folder) {
    ProjectionOptions options;
    options.volume = arguments.volume;
    options.isovalue = arguments.isovalue;
    options.elements_a_side = arguments.names_elements ? arguments.elements.front() : options.elements_a_side;
    options.order = arguments.names_orders ? arguments.orders.front() : options.order;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::vector<ProjectionRow> rows = bench_projection(device, registry, folder, options, [&](const ProjectionRow& row) {
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
        if (!arguments.json) {
            std::printf("%-9s degree %2u (mean %4.1f)  %5.1f evaluations a segment  %6llu hits, %llu missing, %llu other, %llu "
                        "undecided  depth %.1e (%.1e)  normal %.1e (%.1e)  %8.1f ms\n",
                        name_of(row.method), row.degree, row.mean_degree, row.evaluations_a_segment,
                        static_cast<unsigned long long>(row.n_hits), static_cast<unsigned long long>(row.n_missing),
                        static_cast<unsigned long long>(row.n_other), static_cast<unsigned long long>(row.n_undecided),
                        row.mean_depth_error, row.largest_depth_error, row.mean_normal_error, row.largest_normal_error,
                        row.milliseconds);
            std::fflush(stdout);
        }
    });
    if (!arguments.output.empty()) {
        write_projection(arguments.output, rows);
    }
    return list;
}

nlohmann::ordered_json run_combined(const Arguments& arguments, const Device& device, const PluginRegistry& registry,
                                    const BenchFolder& folder) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::uint32_t size = arguments.names_sizes ? arguments.sizes.front() : 1024;
    bench_combined(device, registry, folder, arguments.volume, size, [&](const CombinedRow& row) {
        list.push_back({{"name", row.name},
                        {"milliseconds", row.milliseconds},
                        {"wall_milliseconds", row.wall_milliseconds},
                        {"field_evaluations", row.counts.field_evaluations},
                        {"volume_segments", row.counts.volume_segments},
                        {"hidden_pixels", row.counts.hidden_pixels},
                        {"spared_pixels", row.counts.spared_pixels},
                        {"difference", row.difference}});
        if (!arguments.json) {
            std::printf("%-24s %8.1f ms  wall %8.1f ms  %9llu values  %9llu segments  %8llu pixels hidden  %9llu spared  off by %.1e\n",
                        row.name.c_str(), row.milliseconds, row.wall_milliseconds,
                        static_cast<unsigned long long>(row.counts.field_evaluations),
                        static_cast<unsigned long long>(row.counts.volume_segments),
                        static_cast<unsigned long long>(row.counts.hidden_pixels),
                        static_cast<unsigned long long>(row.counts.spared_pixels), row.difference);
            std::fflush(stdout);
        }
    });
    return list;
}

void run(const Arguments& arguments) {
    nlohmann::ordered_json root;
    const bool all = arguments.suite == "all";
    if (all || arguments.suite == "hierarchy") {
        const HierarchyResult result = bench_hierarchy(2000000);
        root["hierarchy"] = {{"n_items", result.n_items},
                             {"wall_milliseconds", result.wall_milliseconds},
                             {"depth", result.depth},
                             {"boxes_a_query", result.boxes_a_query}};
        if (!arguments.json) {
            std::printf("hierarchy of %llu boxes: %.0f ms, depth %u, %.2f boxes at a point\n",
                        static_cast<unsigned long long>(result.n_items), result.wall_milliseconds, result.depth,
                        result.boxes_a_query);
        }
    }
    if (all || arguments.suite == "jacobian") {
        root["jacobian"] = run_jacobian(arguments);
    }
    if (all || arguments.suite == "roots") {
        root["roots"] = run_roots(arguments);
    }
    if (all || arguments.suite == "unit" || arguments.suite == "cut-plane" || arguments.suite == "boundary" ||
        arguments.suite == "isosurface" || arguments.suite == "segments" || arguments.suite == "surfaces" ||
        arguments.suite == "projection" || arguments.suite == "volume" ||
        arguments.suite == "volume-convergence" || arguments.suite == "combined") {
        const PluginRegistry registry;
        const BenchFolder folder(arguments.data);
        const Device device(arguments.device);
        const double unit = bench_unit(device, registry, folder).nanoseconds;
        root["device"] = device.summary().name;
        root["unit_nanoseconds"] = unit;
        if (!arguments.json) {
            std::printf("%s\nU = %.0f ns: eight values of an order-6 hexahedron on one core\n", device.summary().name.c_str(),
                        unit);
        }
        const auto measure = [&](BenchView view, const char* suite, const char* key) {
            if (!all && arguments.suite != suite) {
                return;
            }
            root[key] = nlohmann::ordered_json::array();
            if (!arguments.json) {
                std::printf("%s\n", key);
            }
            bench_surface(device, registry, folder, view, arguments.elements, arguments.orders, arguments.sizes, unit,
                          [&](const SurfaceResult& result) {
                              root[key].push_back(to_json(result));
                              if (!arguments.json) {
                                  print(result, unit);
                              }
                          });
        };
        measure(BenchView::cut_plane, "cut-plane", "cut_plane");
        measure(BenchView::boundary, "boundary", "boundary");
        measure(BenchView::isosurface_large, "isosurface", "isosurface_large");
        measure(BenchView::isosurface_blobs, "isosurface", "isosurface_blobs");
        measure(BenchView::isosurface_blobs_unskipped, "isosurface", "isosurface_blobs_unskipped");
        if (all || arguments.suite == "segments") {
            root["segments"] = run_segments(arguments, device, registry, folder, unit);
        }
        if (all || arguments.suite == "volume") {
            root["volume"] = run_volume(arguments, device, registry, folder, unit);
        }
        // Minutes, and no part of "all".
        if (arguments.suite == "combined") {
            root["combined"] = run_combined(arguments, device, registry, folder);
        }
        if (arguments.suite == "projection") {
            root["projection"] = run_projection(arguments, device, registry, folder);
        }
        if (arguments.suite == "volume-convergence") {
            root["volume_convergence"] = run_volume_convergence(arguments, device, registry, folder, unit);
        }
        if (arguments.suite == "surfaces") {
            root["surfaces"] = run_surfaces(arguments, device, registry, folder, unit);
        }
    }
    if (arguments.json) {
        std::printf("%s\n", root.dump(2).c_str());
    }
}

} // namespace

void add_bench(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure speed and memory on scenes that anyone can repeat");
    auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("suite", arguments->suite,
                     "unit, cut-plane, boundary, isosurface, segments, volume, hierarchy, jacobian, roots, all of these, surfaces, projection, "
                     "volume-convergence or combined")
        ->check(CLI::IsMember({"unit", "cut-plane", "boundary", "isosurface", "segments", "volume", "hierarchy", "jacobian", "roots",
                               "surfaces", "projection", "volume-convergence", "combined", "all"}))
        ->default_val("all");
    command->add_option("--device", arguments->device, "Name (or part of it) or index of the Vulkan device");
    command->add_option("--data", arguments->data, "Folder to keep the volumes in for the next time");
    command->add_option("--elements", arguments->elements, "Elements along each side")->delimiter(',');
    command->add_option("--orders", arguments->orders, "Orders of the field")->delimiter(',');
    command->add_option("--sizes", arguments->sizes, "Sides of the picture in pixels")->delimiter(',');
    command->add_option("--jacobians", arguments->n_jacobians, "Elements of the suite jacobian")->check(CLI::PositiveNumber);
    command->add_option("--polynomials", arguments->n_polynomials, "Polynomials of the suite roots")
        ->check(CLI::PositiveNumber);
    command->add_flag("--json", arguments->json, "Answer in JSON");
    command->add_option("--volume", arguments->volume, "A native volume for the suites projection, in place of the waves, combined, and volume-convergence");
    command->add_option("--isovalue", arguments->isovalue, "Of the suite projection; by default the middle of the field's range");
    command->add_option("--integrators", arguments->integrators, "Of the suite volume: riemann, trapezoid, categories, adaptive-trapezoid, exact")
        ->delimiter(',');
    command->add_option("--output", arguments->output, "Folder for CSV files and plots of the suites surfaces, projection and volume-convergence");
    command->callback([arguments, command] {
        arguments->names_elements = command->count("--elements") > 0;
        arguments->names_orders = command->count("--orders") > 0;
        arguments->names_sizes = command->count("--sizes") > 0;
        run(*arguments);
    });
}

} // namespace elvis::commands
