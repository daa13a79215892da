#include "files/line_files.hpp"
#include "sample_points.hpp"
#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/number_list.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/render/output_endings.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/error.hpp>
#include <core/base/vector3.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

namespace {

struct StreamlinesArguments {
    VolumeArguments volume;
    std::string field;
    std::vector<std::string> line;
    std::string seeds;
    /** Of surfaces on which seeds are. */
    std::string cut_plane;
    std::vector<std::string> boundary;
    double spacing = 0;
    std::size_t count = 20;
    std::string direction = "both";
    std::vector<std::string> fields;
    double length = 0, tolerance = 0;
    std::uint32_t time_step = 0;
    std::string output;
    /** They are pathlines. */
    bool is_unsteady = false;
    bool is_linear = false;
    std::optional<double> start_time, end_time;
};

/** As a scene has it; empty: seeds are points. */
std::string seed_surface_of(const StreamlinesArguments& arguments) {
    const int n_kinds =
        !arguments.line.empty() + !arguments.seeds.empty() + !arguments.cut_plane.empty() + !arguments.boundary.empty();
    if (n_kinds != 1) {
        throw UsageError(arguments.is_unsteady ? "elvis pathlines" : "elvis streamlines",
                         "takes one of --line, --seeds, --cut-plane and --boundary");
    }
    if (arguments.spacing > 0 && arguments.cut_plane.empty() && arguments.boundary.empty()) {
        throw UsageError("--spacing", "goes with --cut-plane and --boundary");
    }
    if (!arguments.cut_plane.empty()) {
        return nlohmann::json{{"type", "plane"}, {"plane", numbers("--cut-plane", arguments.cut_plane, 4, 4)}}.dump();
    }
    if (arguments.boundary.empty()) {
        return "";
    }
    nlohmann::json surface = {{"type", "boundary"}};
    for (const std::string& name : arguments.boundary) {
        // Without a name the list holds an empty one.
        if (!name.empty() && name != "{}") {
            surface["groups"].push_back(name);
        }
    }
    return surface.dump();
}

std::vector<double> seeds_of(const StreamlinesArguments& arguments) {
    if (!arguments.line.empty()) {
        return points_along({point("--line", arguments.line[0]), point("--line", arguments.line[1])}, arguments.count)
            .positions;
    }
    std::vector<double> seeds;
    if (arguments.seeds.empty()) {
        return seeds;
    }
    for (const Vector3& point : read_points(arguments.seeds)) {
        seeds.insert(seeds.end(), point.begin(), point.end());
    }
    return seeds;
}

traced traced_lines(const data& volume, const StreamlinesArguments& arguments, const std::string& surface,
                    const std::vector<double>& seeds) {
    const std::vector<elvis_string> names = detail::c_strings(arguments.fields);
    auto wanted = detail::sized<elvis_tracing>();
    wanted.time_step = arguments.time_step;
    wanted.field = arguments.field.c_str();
    wanted.seeds = seeds.data();
    wanted.n_seeds = seeds.size() / 3;
    wanted.direction = arguments.direction == "forward"    ? ELVIS_LINE_FORWARD
                       : arguments.direction == "backward" ? ELVIS_LINE_BACKWARD
                                                           : ELVIS_LINE_BOTH;
    wanted.n_fields = static_cast<std::uint32_t>(names.size());
    wanted.fields = names.data();
    wanted.tolerance = arguments.tolerance;
    wanted.length = arguments.length;
    wanted.flags = (arguments.is_unsteady ? ELVIS_TRACE_PATHLINES : 0u) | (arguments.start_time ? ELVIS_TRACE_START_TIME : 0u) |
                   (arguments.end_time ? ELVIS_TRACE_END_TIME : 0u);
    wanted.interpolation = arguments.is_linear ? ELVIS_TIME_LINEAR : ELVIS_TIME_CUBIC;
    wanted.start_time = arguments.start_time.value_or(0);
    wanted.end_time = arguments.end_time.value_or(0);
    wanted.seed_surface = surface.empty() ? nullptr : surface.c_str();
    wanted.seed_spacing = arguments.spacing;
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    return volume.trace(wanted, {[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                                 [&] { return control.is_cancelled(); }});
}

void run_streamlines(const StreamlinesArguments& arguments) {
    need_ending("--output", arguments.output, {".vtp", ".csv"});
    const std::string surface = seed_surface_of(arguments);
    const std::vector<double> seeds = seeds_of(arguments);
    const context library = library_context();
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    const std::vector<LineColumn> columns = line_columns(volume, arguments.fields);
    const traced lines = traced_lines(volume, arguments, surface, seeds);
    write_lines(lines, columns, arguments.output);
    for (const std::string& text : report_of(lines)) {
        std::printf("%s\n", text.c_str());
    }
}

/** What both commands have. */
void add_common(CLI::App& command, StreamlinesArguments& arguments) {
    add_volume_arguments(command, arguments.volume);
    command.add_option("--field", arguments.field, "The vector field or expression")->required();
    command.add_option("--line", arguments.line, "x,y,z x,y,z: seeds evenly along a line")->expected(2);
    command.add_option("--count", arguments.count, "Seeds along the line; default: 20")->check(CLI::Range(1, 1000000));
    command.add_option("--seeds", arguments.seeds, "File with three numbers a line; # starts a comment");
    command.add_option("--cut-plane", arguments.cut_plane, "a,b,c,d: seeds evenly on the plane ax+by+cz+d=0");
    CLI::Option* const boundary =
        command.add_option("--boundary", arguments.boundary,
                           "Seeds evenly on the whole boundary; with a name, on that group of it; may be repeated");
    boundary->expected(0, 1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--spacing", arguments.spacing, "Distance between seeds on surfaces; default: 0.05 of the bounds' diagonal")
        ->check(CLI::PositiveNumber);
    command.add_option("--direction", arguments.direction, "both, forward or backward; default: " + arguments.direction)
        ->check(CLI::IsMember({"both", "forward", "backward"}));
    command.add_option("--values", arguments.fields, "Field or expression whose values are written, too (repeatable)")
        ->allow_extra_args(false);
    command
        .add_option("--tolerance", arguments.tolerance,
                    "Of a step's error, as a share of the diagonal of the bounds; default: 1e-9")
        ->check(CLI::Range(1e-14, 0.01));
    command.add_option("-o,--output", arguments.output, "File to write: .vtp or .csv")->required();
}

} // namespace

void add_streamlines(CLI::App& app) {
    auto arguments = std::make_shared<StreamlinesArguments>();
    CLI::App* command = app.add_subcommand("streamlines", "Write curves that are everywhere tangent to a vector field");
    add_common(*command, *arguments);
    command->add_option("--length", arguments->length, "Of a line in each direction; default: ten times the diagonal")
        ->check(CLI::PositiveNumber);
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command->callback([arguments] { run_streamlines(*arguments); });
}

void add_pathlines(CLI::App& app) {
    auto arguments = std::make_shared<StreamlinesArguments>();
    arguments->is_unsteady = true;
    arguments->direction = "forward";
    CLI::App* command = app.add_subcommand("pathlines", "Write the ways of points that move with a vector field in time");
    add_common(*command, *arguments);
    command->add_option("--length", arguments->length, "Of a line in each direction; default: no limit")
        ->check(CLI::PositiveNumber);
    command->add_option("--start-time", arguments->start_time,
                        "When points are at their seeds; default: the first time step's time, backward the last one's");
    command->add_option("--end-time", arguments->end_time,
                        "Till when, or backward since when, they are followed; default: as far as time steps go");
    command
        ->add_option_function<std::string>(
            "--interpolation", [arguments](const std::string& word) { arguments->is_linear = word == "linear"; },
            "Between time steps: cubic (default) or linear")
        ->check(CLI::IsMember({"cubic", "linear"}));
    command->callback([arguments] { run_streamlines(*arguments); });
}

} // namespace elvis::commands
