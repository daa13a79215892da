#include "commands.hpp"
#include "crash_report.hpp"
#include "library_context.hpp"
#include "long_task.hpp"
#include "removal_of_temporary.hpp"
#include <apps/elvis/render/output_endings.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/team.hpp>
#include <core/convert/request.hpp>

#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <memory>

namespace elvis::commands {

namespace {

struct ConvertArguments {
    std::vector<std::string> inputs;
    std::string output;
    std::string plugin;
    std::string options;
    std::string continuity;
    std::string report;
    std::vector<std::string> fields;
    int order = -1;
    bool json = false;
    bool is_separate = false;
    /** Mebibytes; 0: what the machine has left. */
    std::uint64_t memory_limit = 0;
    /** Of the process that converts for another. */
    int answer = -1;
};

void print_table(const ConvertReport& report, const std::string& output) {
    for (const auto& [shape, count] : report.elements) {
        std::printf("%s\n", counted(count, shape + " element").c_str());
    }
    for (const FieldReport& field : report.fields) {
        const bool has_gaps = field.n_not_finite > 0;
        const std::string gaps = has_gaps ? ", not a number in " + counted(field.n_not_finite, "element") : std::string();
        std::printf("field %s: %s, residual %.3g of its range, largest jump %.3g%s\n", field.name.c_str(),
                    field.exact ? "exact but for round-off" : "NOT exact", field.residual, field.max_jump, gaps.c_str());
    }
    if (report.n_unknown_faces > 0) {
        std::printf("%s whose neighbour is unknown\n", counted(report.n_unknown_faces, "face").c_str());
    }
    std::printf("%s written in %.2f s\n", output.c_str(), report.seconds);
}

void write_report(const ConvertReport& report, const std::string& path) {
    std::ofstream file(path);
    file << to_json(report) << '\n';
    if (!file.flush()) {
        throw Error(path, "the report cannot be written");
    }
}

ConvertRequest request_of(const ConvertArguments& arguments) {
    ConvertRequest request{arguments.inputs, arguments.output, arguments.plugin, arguments.options, {}};
    ConvertOptions& options = request.options;
    options.program_version = ELVIS_VERSION;
    options.fields = arguments.fields;
    if (arguments.order >= 0) {
        options.order = static_cast<std::uint32_t>(arguments.order);
    }
    if (!arguments.continuity.empty()) {
        options.continuity = arguments.continuity == "cg" ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
    }
    return request;
}

/** In this process, by the library. */
ConvertReport convert_here(const ConvertArguments& arguments) {
    const auto pointers = [](const std::vector<std::string>& texts) {
        std::vector<elvis_string> all;
        for (const std::string& text : texts) {
            all.push_back(text.c_str());
        }
        return all;
    };
    const std::vector<elvis_string> inputs = pointers(arguments.inputs), fields = pointers(arguments.fields);
    auto conversion = detail::sized<elvis_conversion>();
    conversion.n_inputs = static_cast<std::uint32_t>(inputs.size());
    conversion.inputs = inputs.data();
    conversion.output = arguments.output.c_str();
    conversion.plugin = detail::or_null(arguments.plugin);
    conversion.options = detail::or_null(arguments.options);
    conversion.n_fields = static_cast<std::uint32_t>(fields.size());
    conversion.fields = fields.data();
    conversion.order = arguments.order;
    conversion.continuity = arguments.continuity.empty()   ? ELVIS_CONTINUITY_UNKNOWN
                            : arguments.continuity == "cg" ? ELVIS_CONTINUITY_CONTINUOUS
                                                           : ELVIS_CONTINUITY_DISCONTINUOUS;
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    const task watch{[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                     [&] { return control.is_cancelled(); }};
    return report_from_json(library_context().convert(conversion, watch));
}

ConvertReport convert_apart(const ConvertArguments& arguments) {
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control, SecondInterrupt::is_counted);
    ConvertProcess process;
    process.most_bytes = arguments.memory_limit << 20u;
    if (const auto level = spdlog::get_level(); level != spdlog::level::info) {
        process.first_arguments = {level < spdlog::level::info ? "--verbose" : "--quiet"};
    }
    process.is_urgent = [] { return n_interrupts > 1; };
    return convert_separately(request_of(arguments), control, process);
}

/** In the process that convert_separately started. */
void answer(const ConvertArguments& arguments) {
    report_crashes_to(arguments.answer, crash_mark);
    TaskControl control;
    const InterruptGuard guard(control, SecondInterrupt::is_ignored);
    answer_conversion(request_of(arguments), control, arguments.answer);
}

/** By all processes of a team; the report is that of the first. */
ConvertReport convert_together(const ConvertArguments& arguments, Team& team) {
    if (arguments.is_separate) {
        throw UsageError("--separate-process", "does not go with many processes");
    }
    const RemovalOfTemporary removal(arguments.output, team);
    return convert(request_of(arguments), {}, {}, &team);
}

void run_convert(const ConvertArguments& arguments, Team* team) {
    need_hdf5_ending("--output", arguments.output);
    if (!arguments.report.empty()) {
        need_ending("--report", arguments.report, {".json"});
    }
    const ConvertReport report = team != nullptr         ? convert_together(arguments, *team)
                                 : arguments.is_separate ? convert_apart(arguments)
                                                         : convert_here(arguments);
    if (team != nullptr && !team->is_first()) {
        return;
    }
    if (!arguments.report.empty()) {
        write_report(report, arguments.report);
    }
    if (arguments.json) {
        std::printf("%s\n", to_json(report).c_str());
    } else {
        print_table(report, arguments.output);
    }
}

} // namespace

void add_convert(CLI::App& app, Team* team) {
    CLI::App* command = app.add_subcommand("convert", "Convert a foreign data set to a native volume");
    auto arguments = std::make_shared<ConvertArguments>();
    command->add_option("inputs", arguments->inputs, "Geometry first, then field files")->required();
    command->add_option("-o,--output", arguments->output, "Native volume to write")->required();
    command->add_option("--plugin", arguments->plugin, "Id of the conversion plugin (default: the one surest of the file)");
    command->add_option("--options", arguments->options, "Options of the plugin, a JSON object");
    command->add_option("--order", arguments->order, "Order of every field (default: what contains the source)")
        ->check(CLI::Range(0, 30));
    command->add_option("--continuity", arguments->continuity, "cg (continuous) or dg (discontinuous)")
        ->check(CLI::IsMember({"cg", "dg"}));
    command->add_option("--fields", arguments->fields, "Only these fields, separated by commas")->delimiter(',');
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
