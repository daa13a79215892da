#include "conversion.hpp"
#include "convert_together.hpp"

#include <apps/elvis/commands.hpp>
#include <apps/elvis/crash_report.hpp>
#include <apps/elvis/long_task.hpp>
#include <apps/elvis/removal_of_temporary.hpp>
#include <apps/elvis/render/output_endings.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/team.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

namespace elvis::commands {

namespace {

using nlohmann::json;

struct ConvertArguments {
    Conversion conversion;
    std::string report;
    bool json = false;
    bool is_separate = false;
    /** Mebibytes; 0: what the machine has left. */
    std::uint64_t memory_limit = 0;
    /** Of the process that converts for another. */
    int answer = -1;
};

/** Null is no number. */
double number_of(const json& value) { return value.is_number() ? value.get<double>() : std::nan(""); }

void print_table(const json& report, const std::string& output) {
    for (const auto& [shape, count] : report["elements"].items()) {
        std::printf("%s\n", counted(count.get<std::uint64_t>(), shape + " element").c_str());
    }
    for (const json& field : report["fields"]) {
        const auto n_gaps = field["elements_not_finite"].get<std::uint64_t>();
        const std::string gaps = n_gaps > 0 ? ", not a number in " + counted(n_gaps, "element") : std::string();
        std::printf("field %s: %s, residual %.3g of its range, largest jump %.3g%s\n", field["name"].get<std::string>().c_str(),
                    field["exact"] ? "exact but for round-off" : "NOT exact", number_of(field["residual"]),
                    number_of(field["max_jump"]), gaps.c_str());
    }
    if (const auto n_unknown = report["faces"]["unknown_neighbour"].get<std::uint64_t>(); n_unknown > 0) {
        std::printf("%s whose neighbour is unknown\n", counted(n_unknown, "face").c_str());
    }
    std::printf("%s written in %.2f s\n", output.c_str(), report["seconds"].get<double>());
}

void write_report(const std::string& report, const std::string& path) {
    std::ofstream file(path);
    file << report << '\n';
    if (!file.flush()) {
        throw Error(path, "the report cannot be written");
    }
}

std::string convert_watched(const Conversion& conversion) {
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    return convert_here(conversion, control);
}

std::string convert_apart(const ConvertArguments& arguments) {
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control, SecondInterrupt::is_counted);
    ConvertProcess process;
    process.most_bytes = arguments.memory_limit << 20u;
    if (const auto level = spdlog::get_level(); level != spdlog::level::info) {
        process.first_arguments = {level < spdlog::level::info ? "--verbose" : "--quiet"};
    }
    process.is_urgent = [] { return n_interrupts > 1; };
    return convert_separately(arguments.conversion, control, process);
}

/** In the process that convert_separately started. */
void answer(const ConvertArguments& arguments) {
    report_crashes_to(arguments.answer, crash_mark);
    TaskControl control;
    const InterruptGuard guard(control, SecondInterrupt::is_ignored);
    answer_conversion(arguments.conversion, control, arguments.answer);
}

/** By all processes of a team. */
std::string convert_in_team(const ConvertArguments& arguments, Team& team) {
    if (arguments.is_separate) {
        throw UsageError("--separate-process", "does not go with many processes");
    }
    const RemovalOfTemporary removal(arguments.conversion.output, team);
    return convert_together(arguments.conversion, team);
}

void run_convert(const ConvertArguments& arguments, Team* team) {
    need_hdf5_ending("--output", arguments.conversion.output);
    if (!arguments.report.empty()) {
        need_ending("--report", arguments.report, {".json"});
    }
    const std::string report = team != nullptr         ? convert_in_team(arguments, *team)
                               : arguments.is_separate ? convert_apart(arguments)
                                                       : convert_watched(arguments.conversion);
    if (team != nullptr && !team->is_first()) {
        return;
    }
    if (!arguments.report.empty()) {
        write_report(report, arguments.report);
    }
    if (arguments.json) {
        std::printf("%s\n", report.c_str());
    } else {
        print_table(json::parse(report), arguments.conversion.output);
    }
}

} // namespace

void add_convert(CLI::App& app, Team* team) {
    CLI::App* command = app.add_subcommand("convert", "Convert a foreign data set to a native volume");
    auto arguments = std::make_shared<ConvertArguments>();
    Conversion& wanted = arguments->conversion;
    command->add_option("inputs", wanted.inputs, "Geometry first, then field files")->required();
    command->add_option("-o,--output", wanted.output, "Native volume to write")->required();
    command->add_option("--plugin", wanted.plugin, "Id of the conversion plugin (default: the one surest of the file)");
    command->add_option("--options", wanted.options, "Options of the plugin, a JSON object");
    command->add_option("--order", wanted.order, "Order of every field (default: what contains the source)")
        ->check(CLI::Range(0, 30));
    command->add_option("--continuity", wanted.continuity, "cg (continuous) or dg (discontinuous)")
        ->check(CLI::IsMember({"cg", "dg"}));
    command->add_option("--fields", wanted.fields, "Only these fields, separated by commas")->delimiter(',');
    command->add_option("--report", arguments->report, "JSON file with residuals, jumps and times");
    command->add_flag("--json", arguments->json, "Print the report in JSON");
    CLI::Option* separate = command->add_flag(
        "--separate-process", arguments->is_separate,
        "Run the plugin in a process of its own: one that crashes, hangs or takes all memory ends alone, with a message");
    command
        ->add_option("--memory-limit", arguments->memory_limit,
                     "Mebibytes that the separate process may take (default: nearly all that the machine has left)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40u))
        ->needs(separate);
    // The program calls itself with this.
    command->add_option("--answer", arguments->answer)->group("");
    command->callback([arguments, team] { arguments->answer >= 0 ? answer(*arguments) : run_convert(*arguments, team); });
}

} // namespace elvis::commands
