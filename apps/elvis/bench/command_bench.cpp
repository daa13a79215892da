#include "bench_suites.hpp"
#include <apps/elvis/commands.hpp>

#include <core/base/error.hpp>
#include <core/session/volume/open_volume.hpp>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <functional>
#include <memory>

namespace elvis::commands {

namespace {

struct Suite {
    const char* name;
    const char* key;
    std::function<nlohmann::ordered_json(const Bench&)> run;
    /** Minutes, or hours, if not. */
    bool is_part_of_all = true;
};

/** Those that draw; in the order in which they run. */
const std::vector<Suite>& drawing_suites() {
    const auto view = [](BenchView of) { return [of](const Bench& bench) { return run_surface(bench, of); }; };
    static const std::vector<Suite> suites{
        {"cut-plane", "cut_plane", view(BenchView::cut_plane)},
        {"boundary", "boundary", view(BenchView::boundary)},
        {"isosurface", "isosurface_large", view(BenchView::isosurface_large)},
        {"isosurface", "isosurface_blobs", view(BenchView::isosurface_blobs)},
        {"isosurface", "isosurface_blobs_unskipped", view(BenchView::isosurface_blobs_unskipped)},
        {"segments", "segments", run_segments},
        {"volume", "volume", run_volume},
        {"projection", "projection", run_projection, false},
        {"combined", "combined", run_combined, false},
        {"mfem", "mfem", run_mfem, false},
        {"volume-convergence", "volume_convergence", run_volume_convergence, false},
        {"surfaces", "surfaces", run_surfaces, false},
        {"interface", "interface", run_interface, false},
        {"growth", "growth", run_growth, false},
        {"goals", "goals", run_goals, false},
    };
    return suites;
}

void run_drawing_suites(const BenchArguments& arguments, nlohmann::ordered_json& root) {
    const auto is_wanted = [&](const Suite& suite) {
        return arguments.suite == suite.name || (arguments.suite == "all" && suite.is_part_of_all);
    };
    if (arguments.suite != "unit" && std::ranges::none_of(drawing_suites(), is_wanted)) {
        return;
    }
    const PluginRegistry registry;
    const BenchFolder folder(arguments.data);
    const Device device(arguments.device);
    const double unit = bench_unit(device, registry, folder).nanoseconds;
    root["device"] = device.summary().name;
    root["unit_nanoseconds"] = unit;
    say(arguments, "%s\nU = %.0f ns: eight values of an order-6 hexahedron on one core\n", device.summary().name.c_str(), unit);
    for (const Suite& suite : drawing_suites()) {
        if (is_wanted(suite)) {
            say(arguments, "%s\n", suite.key);
            root[suite.key] = suite.run({arguments, device, registry, folder, unit});
        }
    }
}

/** The one that --volume names: its plugin's own file, or what a conversion made of it. */
VolumeFile volume_file(const BenchArguments& arguments) {
    return arguments.volume.empty() ? VolumeFile{} : find_volume(PluginRegistry(), {arguments.volume}, {}, {}, {});
}

void run(BenchArguments arguments) {
    const VolumeFile volume = volume_file(arguments);
    arguments.volume = volume.path;
    nlohmann::ordered_json root;
    const auto is_wanted = [&](const char* suite) { return arguments.suite == "all" || arguments.suite == suite; };
    if (is_wanted("hierarchy")) {
        root["hierarchy"] = run_hierarchy(arguments);
    }
    if (is_wanted("jacobian")) {
        root["jacobian"] = run_jacobian(arguments);
    }
    if (is_wanted("roots")) {
        root["roots"] = run_roots(arguments);
    }
    // It names its own device, which may be one that cannot draw.
    if (arguments.suite == "kernels") {
        root["kernels"] = run_kernels(arguments);
    }
    run_drawing_suites(arguments, root);
    bool is_good = true;
    if (arguments.suite == "accuracy") {
        root["accuracy"] = run_accuracy(arguments, is_good);
    }
    if (arguments.json) {
        std::printf("%s\n", root.dump(2).c_str());
    }
    if (!is_good) {
        throw Error("elvis bench accuracy", "pixels are wrong and do not say so: see above");
    }
}

void add_accuracy(CLI::App& command, BenchArguments::Accuracy& accuracy) {
    command.add_option("--count", accuracy.count, "Of the suite accuracy: number of random fields")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--seed", accuracy.seed, "Of its first field; the others follow")->capture_default_str();
    command.add_option("--size", accuracy.size, "Side of its pictures in pixels")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command
        .add_option_function<std::vector<std::string>>(
            "--precision",
            [&accuracy](const std::vector<std::string>& names) {
                accuracy.precisions.clear();
                for (const std::string& name : names) {
                    if (const std::optional<Precision> precision = precision_named(name)) {
                        accuracy.precisions.push_back(*precision);
                    }
                }
            },
            "Of its pictures, and of the suite kernels: float32, float64 or both; none: the exact renderer alone")
        ->delimiter(',')
        ->check(CLI::IsMember({name_of(Precision::float32), name_of(Precision::float64), "none"}));
    command
        .add_option("--finder-stride", accuracy.finder_stride,
                    "The exact renderer's ways are compared on every so many rays; 0: not at all")
        ->capture_default_str();
    command.add_option("--method", accuracy.method, "How its crossings are found")
        ->check(CLI::IsMember({"interval", "bernstein", "companion"}))
        ->capture_default_str();
}

} // namespace

void say(const BenchArguments& arguments, const char* format, ...) {
    if (arguments.json) {
        return;
    }
    std::va_list values;
    va_start(values, format);
    std::vprintf(format, values);
    va_end(values);
    std::fflush(stdout);
}

void add_bench(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure speed, memory and accuracy on scenes that anyone can repeat");
    auto arguments = std::make_shared<BenchArguments>();
    std::vector<std::string> suites{"unit", "hierarchy", "jacobian", "roots", "accuracy", "kernels", "all"};
    for (const Suite& suite : drawing_suites()) {
        if (std::ranges::find(suites, suite.name) == suites.end()) {
            suites.emplace_back(suite.name);
        }
    }
    command
        ->add_option("suite", arguments->suite,
                     "unit, cut-plane, boundary, isosurface, segments, volume, hierarchy, jacobian, roots, all of these, "
                     "surfaces, projection, "
                     "combined, mfem, volume-convergence, interface, growth, goals, kernels or accuracy")
        ->check(CLI::IsMember(std::move(suites)))
        ->default_val("all");
    command->add_option("--device", arguments->device, "Name (or part of it), index, PCI bus id or UUID of the Vulkan device");
    command->add_option("--data", arguments->data, "Folder to keep the volumes in for the next time");
    command->add_option("--elements", arguments->elements, "Elements along each side")->delimiter(',');
    command->add_option("--orders", arguments->orders, "Orders of the field")->delimiter(',');
    command->add_option("--sizes", arguments->sizes, "Sides of the picture in pixels")->delimiter(',');
    command->add_option("--jacobians", arguments->n_jacobians, "Elements of the suite jacobian")->check(CLI::PositiveNumber);
    command->add_option("--polynomials", arguments->n_polynomials, "Polynomials of the suite roots")
        ->check(CLI::PositiveNumber);
    command->add_flag("--json", arguments->json, "Answer in JSON");
    command->add_option(
        "--volume", arguments->volume,
        "A volume of any format for the suites projection, combined, interface and kernels, in place of the waves, mfem, "
        "goals and volume-convergence");
    command->add_option("--shapes", arguments->shapes, "Of the suite kernels: hexahedron, prism, pyramid, tetrahedron")
        ->delimiter(',')
        ->check(CLI::IsMember({"hexahedron", "prism", "pyramid", "tetrahedron"}));
    command->add_option("--isovalue", arguments->isovalue,
                        "Of the suites projection, by default the middle of the field's range, and combined, at 0.6 of it");
    command
        ->add_option("--integrators", arguments->integrators,
                     "Of the suite volume: riemann, trapezoid, categories, adaptive-trapezoid, exact")
        ->delimiter(',');
    command->add_option("--output", arguments->output,
                        "Folder for CSV files and plots of the suites surfaces, projection, volume-convergence and kernels");
    add_accuracy(*command, arguments->accuracy);
    command->callback([arguments, command] {
        arguments->names_elements = command->count("--elements") > 0;
        arguments->names_orders = command->count("--orders") > 0;
        arguments->names_sizes = command->count("--sizes") > 0;
        run(*arguments);
    });
}

} // namespace elvis::commands
