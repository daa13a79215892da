#include "files/mesh_files.hpp"
#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/number_list.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/error.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {

namespace {

struct ExtractArguments {
    VolumeArguments volume;
    std::string field, level_field;
    bool is_boundary = false;
    std::vector<std::string> groups;
    std::string plane, isovalue, contours;
    std::vector<std::string> values;
    double tolerance = 0;
    std::uint32_t time_step = 0;
    bool is_json = false;
    std::string output;
};

/** Before anything is opened. */
void check_extract(const ExtractArguments& arguments) {
    const auto ends_in = [&](const char* ending) { return arguments.output.ends_with(ending); };
    if (!ends_in(".vtp") && !ends_in(".ply") && !ends_in(".stl") && !ends_in(".glb")) {
        throw UsageError("--output", "'" + arguments.output + "' ends in none of .vtp, .ply, .stl and .glb");
    }
    if (ends_in(".stl") && !arguments.contours.empty()) {
        throw UsageError(arguments.output, "holds triangles alone; .vtp, .ply and .glb hold lines, too");
    }
    if (ends_in(".stl") && !arguments.values.empty()) {
        throw UsageError(arguments.output, "holds no values; .vtp, .ply and .glb do");
    }
    if (int{arguments.is_boundary} + int{!arguments.plane.empty()} + int{!arguments.isovalue.empty()} > 1) {
        throw UsageError("elvis extract", "takes one of --isosurface, --cut-plane and --boundary");
    }
    if (!arguments.isovalue.empty() && arguments.level_field.empty() && arguments.field.empty()) {
        throw UsageError("--isosurface", "which field's? --field or --isosurface-field says it");
    }
    if (!arguments.contours.empty() && arguments.field.empty()) {
        throw UsageError("--contours", "which field's? --field says it");
    }
}

extracted mesh_of(const context& library, const data& volume, const ExtractArguments& arguments) {
    const std::string& level_field = arguments.level_field.empty() ? arguments.field : arguments.level_field;
    const std::vector<elvis_string> groups = detail::c_strings(arguments.groups), values = detail::c_strings(arguments.values);
    std::vector<double> contours;
    if (!arguments.contours.empty()) {
        contours = numbers("--contours", arguments.contours, 1, std::numeric_limits<std::size_t>::max());
    }
    auto wanted = detail::sized<elvis_extraction>();
    wanted.domain = ELVIS_DOMAIN_BOUNDARY;
    wanted.groups = groups.data();
    wanted.n_groups = static_cast<std::uint32_t>(groups.size());
    wanted.time_step = arguments.time_step;
    if (!arguments.plane.empty()) {
        wanted.domain = ELVIS_DOMAIN_PLANE;
        std::ranges::copy(numbers("--cut-plane", arguments.plane, 4, 4), wanted.plane);
    } else if (!arguments.isovalue.empty()) {
        wanted.domain = ELVIS_DOMAIN_ISOSURFACE;
        wanted.level_field = level_field.c_str();
        wanted.isovalue = numbers("--isosurface", arguments.isovalue, 1, 1).front();
    }
    wanted.contour_field = arguments.field.c_str();
    wanted.contours = contours.data();
    wanted.n_contours = static_cast<std::uint32_t>(contours.size());
    wanted.fields = values.data();
    wanted.n_fields = static_cast<std::uint32_t>(values.size());
    wanted.tolerance = arguments.tolerance;
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    return extract(library, volume, wanted,
                   {[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                    [&] { return control.is_cancelled(); }});
}

void print_mesh_json(const elvis_mesh_info& info) {
    const bool has_lines = info.n_lines > 0;
    nlohmann::ordered_json answer = {{"vertices", info.n_vertices}, {"triangles", info.n_triangles}, {"lines", info.n_lines}};
    answer[has_lines ? "length" : "area"] = info.measure;
    if (!has_lines) {
        answer["volume"] = info.n_rim_edges + info.n_inner_edges == 0 ? nlohmann::ordered_json(info.volume) : nullptr;
        answer["euler_number"] = info.euler_number;
        answer["open_edges"] = {{"rim", info.n_rim_edges}, {"inner", info.n_inner_edges}};
        answer["branching_edges"] = info.n_branching_edges;
    } else {
        answer["open_ends"] = info.n_open_ends;
    }
    answer["deviation"] = {{"mesh_to_surface", info.mesh_to_surface}, {"surface_to_mesh", info.surface_to_mesh}};
    answer["tolerance"] = info.tolerance;
    answer["certified"] = info.is_certified != 0;
    answer["sampled_elements"] = info.n_sampled_elements;
    answer["undecided"] = info.n_undecided;
    answer["evaluations"] = info.n_evaluations;
    std::printf("%s\n", answer.dump(2).c_str());
}

void print_mesh_report(const elvis_mesh_info& info, const std::string& path) {
    const std::vector<std::string> report = report_of(info);
    std::printf("%s written to %s\n", report.front().c_str(), path.c_str());
    for (std::size_t line = 1; line < report.size(); ++line) {
        std::printf("  %s\n", report[line].c_str());
    }
}

void run_extract(const ExtractArguments& arguments) {
    check_extract(arguments);
    const context library = library_context();
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    const std::vector<MeshColumn> columns = mesh_columns(volume, arguments.values);
    const extracted mesh = mesh_of(library, volume, arguments);
    write_mesh(mesh, columns, arguments.output);
    if (arguments.is_json) {
        print_mesh_json(mesh.info);
    } else {
        print_mesh_report(mesh.info, arguments.output);
    }
    for (const std::string& doubt : doubts_of(mesh.info)) {
        std::fprintf(stderr, "elvis: %s\n", doubt.c_str());
    }
}

} // namespace

void add_extract(CLI::App& app) {
    auto arguments = std::make_shared<ExtractArguments>();
    CLI::App* command = app.add_subcommand("extract", "Write meshes of isosurfaces, cut planes and boundaries, and contours");
    add_volume_arguments(*command, arguments->volume);
    command->add_option("--field", arguments->field, "Field, component or expression of isosurface and contours");
    command->add_option("--isosurface", arguments->isovalue, "The isosurface at this value");
    command->add_option("--isosurface-field", arguments->level_field,
                        "Field or expression of the isosurface; default: --field");
    command->add_option("--cut-plane", arguments->plane, "The plane a,b,c,d: ax+by+cz+d=0");
    command
        ->add_option("--boundary", arguments->groups,
                     "The whole boundary, which is the default; with a name, that group of it; may be repeated")
        ->expected(0, 1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--contours", arguments->contours,
                        "v,v,...: in place of the surface the lines on it where --field has these values");
    command->add_option("--values", arguments->values, "Field or expression whose values are written, too (repeatable)")
        ->allow_extra_args(false);
    command
        ->add_option("--tolerance", arguments->tolerance,
                     "How far mesh and surface may be from each other, as a share of the diagonal of the bounds; default: 1e-3")
        ->check(CLI::Range(1e-9, 0.5));
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command->add_flag("--json", arguments->is_json, "Print the report as JSON");
    command->add_option("-o,--output", arguments->output, "File to write: .vtp, .ply, .stl or .glb")->required();
    command->callback([arguments, command] {
        arguments->is_boundary = command->count("--boundary") > 0;
        // Without a name the list holds an empty one.
        std::erase_if(arguments->groups, [](const std::string& name) { return name.empty() || name == "{}"; });
        run_extract(*arguments);
    });
}

} // namespace elvis::commands
