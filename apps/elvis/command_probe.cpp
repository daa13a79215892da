#include "commands.hpp"

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/probe.hpp>
#include <core/session/open_volume.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string_view>

namespace elvis::commands {
namespace {

struct Arguments {
    std::string volume;
    std::string plugin;
    std::vector<std::string> points;
    std::string points_file;
    std::vector<std::string> expressions;
    std::uint32_t time_step = 0;
    std::string evaluation = "auto";
    std::string device;
    bool json = false;
};

/** Three numbers separated by commas or white space, and nothing else. */
std::optional<Vector3> parse_position(std::string_view text) {
    Vector3 position{};
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto skip_space = [&] {
        while (at != end && (*at == ' ' || *at == '\t' || *at == '\r'))
            ++at;
    };
    for (std::size_t i = 0; i < 3; ++i) {
        skip_space();
        if (i > 0 && at != end && *at == ',') {
            ++at;
            skip_space();
        }
        // std::from_chars takes no plus sign.
        if (end - at > 1 && *at == '+' && at[1] != '-')
            ++at;
        const auto [after, error] = std::from_chars(at, end, position[i]);
        if (error != std::errc{} || (after != end && i < 2 && *after != ',' && *after != ' ' && *after != '\t'))
            return std::nullopt;
        at = after;
    }
    skip_space();
    return at == end ? std::optional(position) : std::nullopt;
}

void read_points(const std::string& path, std::vector<Vector3>& positions) {
    std::ifstream file(path);
    if (!file)
        throw Error(path, "cannot be opened");
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#')
            continue;
        const std::optional<Vector3> position = parse_position(line);
        if (!position)
            throw Error(path + ":" + std::to_string(number), "expected three numbers, found '" + line + "'");
        positions.push_back(*position);
    }
    if (file.bad())
        throw Error(path, "cannot be read");
}

std::vector<Vector3> positions_of(const Arguments& arguments) {
    std::vector<Vector3> positions;
    for (const std::string& text : arguments.points) {
        const std::optional<Vector3> position = parse_position(text);
        if (!position)
            throw UsageError("--point", "expected x,y,z, found '" + text + "'");
        positions.push_back(*position);
    }
    if (!arguments.points_file.empty())
        read_points(arguments.points_file, positions);
    else if (positions.empty())
        throw UsageError("elvis probe", "needs --point x,y,z or --points FILE");
    return positions;
}

ProbeOptions options_of(const Arguments& arguments) {
    ProbeOptions options;
    options.device = arguments.device;
    if (arguments.evaluation == "cpu")
        options.evaluation = ProbeOptions::Evaluation::cpu;
    else if (arguments.evaluation == "device")
        options.evaluation = ProbeOptions::Evaluation::device;
    return options;
}

using Expressions = std::vector<std::shared_ptr<const Expression>>;

void print_json(const RuntimeVolume& volume, const Expressions& expressions, const std::vector<ProbedPoint>& points) {
    nlohmann::ordered_json answers = nlohmann::ordered_json::array();
    for (const ProbedPoint& point : points) {
        nlohmann::ordered_json answer;
        nlohmann::ordered_json values = nlohmann::ordered_json::object();
        nlohmann::ordered_json gradients = nlohmann::ordered_json::object();
        for (std::size_t i = 0; i < point.fields.size(); ++i) {
            const std::string& name = volume.fields()[i].name;
            const FieldSample& sample = point.fields[i];
            values[name] = sample.values;
            gradients[name] = nlohmann::ordered_json::array();
            for (std::size_t c = 0; c < sample.values.size(); ++c)
                gradients[name].push_back({sample.gradients[3 * c], sample.gradients[3 * c + 1], sample.gradients[3 * c + 2]});
        }
        answer["x"] = point.position;
        answer["element"] = point.element ? nlohmann::ordered_json(*point.element) : nlohmann::ordered_json();
        answer["xi"] = point.element ? nlohmann::ordered_json(point.xi) : nlohmann::ordered_json();
        answer["fields"] = std::move(values);
        answer["gradients"] = std::move(gradients);
        answer["also"] = point.also;
        answer["gradients_estimated"] =
            std::ranges::any_of(point.fields, [](const FieldSample& sample) { return sample.gradient_is_estimated; });
        if (!expressions.empty()) {
            answer["expressions"] = nlohmann::ordered_json::object();
            for (std::size_t i = 0; i < point.expressions.size(); ++i) {
                const ExpressionSample& sample = point.expressions[i];
                answer["expressions"][expressions[i]->text()] = {{"value", sample.value},
                                                                 {"gradient", sample.gradient},
                                                                 {"value_estimated", sample.value_is_estimated},
                                                                 {"gradient_estimated", sample.gradient_is_estimated}};
            }
        }
        answer["newton_failures"] = point.n_failures;
        answers.push_back(std::move(answer));
    }
    nlohmann::ordered_json document;
    document["points"] = std::move(answers);
    std::printf("%s\n", document.dump(2).c_str());
}

void print_table(const RuntimeVolume& volume, const Expressions& expressions, const std::vector<ProbedPoint>& points) {
    for (const ProbedPoint& point : points) {
        std::printf("x = (%.17g, %.17g, %.17g)\n", point.position[0], point.position[1], point.position[2]);
        if (!point.element) {
            std::printf("  in no element\n");
            continue;
        }
        std::printf("  element %lld", static_cast<long long>(*point.element));
        for (std::size_t i = 0; i < point.also.size(); ++i)
            std::printf("%s%lld", i == 0 ? ", also " : ", ", static_cast<long long>(point.also[i]));
        std::printf("\n  xi = (%.17g, %.17g, %.17g)\n", point.xi[0], point.xi[1], point.xi[2]);
        for (std::size_t i = 0; i < point.fields.size(); ++i) {
            const FieldInfo& field = volume.fields()[i];
            const FieldSample& sample = point.fields[i];
            for (std::size_t c = 0; c < sample.values.size(); ++c) {
                std::string component;
                if (sample.values.size() > 1)
                    component.append("[").append(std::to_string(c)).append("]");
                std::printf("  %s%s = %.17g%s%s, gradient (%.17g, %.17g, %.17g)%s\n", field.name.c_str(), component.c_str(),
                            sample.values[c], field.unit.empty() ? "" : " ", field.unit.c_str(), sample.gradients[3 * c],
                            sample.gradients[3 * c + 1], sample.gradients[3 * c + 2],
                            sample.gradient_is_estimated ? ", estimated" : "");
            }
        }
        for (std::size_t i = 0; i < point.expressions.size(); ++i) {
            const ExpressionSample& sample = point.expressions[i];
            std::printf("  %s = %.17g%s, gradient (%.17g, %.17g, %.17g)%s\n", expressions[i]->text().c_str(), sample.value,
                        sample.value_is_estimated ? ", estimated" : "", sample.gradient[0], sample.gradient[1],
                        sample.gradient[2], sample.gradient_is_estimated ? ", estimated" : "");
        }
    }
}

void run(const Arguments& arguments) {
    const std::vector<Vector3> positions = positions_of(arguments);
    const PluginRegistry registry;
    const RuntimeVolume volume = open_volume(registry, arguments.volume, arguments.plugin, {});
    Expressions expressions;
    for (const std::string& text : arguments.expressions)
        expressions.push_back(std::make_shared<const Expression>(text, volume.fields(), volume.dimension()));
    Prober prober(volume, options_of(arguments));
    const std::vector<ProbedPoint> points = prober.probe(positions, arguments.time_step, expressions);
    if (arguments.json)
        print_json(volume, expressions, points);
    else
        print_table(volume, expressions, points);

    std::size_t n_unknown = 0;
    for (const ProbedPoint& point : points)
        n_unknown += !point.element && point.n_failures > 0;
    if (n_unknown > 0)
        throw Error(arguments.volume, "the inverse mapping failed at " + counted(n_unknown, "point") +
                                          ": whether they lie in the volume is not known");
}

} // namespace

void add_probe(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("probe", "Print element, reference coordinates and fields at points, in double precision");
    command->add_option("volume", arguments->volume, "Volume file")->required();
    command->add_option("--plugin", arguments->plugin, "Runtime plugin by id; default: the one surest of the file");
    command->add_option("--point", arguments->points, "Point x,y,z (repeatable)")->allow_extra_args(false);
    command->add_option("--points", arguments->points_file, "File with three numbers a line; # starts a comment");
    command
        ->add_option("--field", arguments->expressions,
                     "Expression over the fields, e.g. \"norm(curl(u))\", to evaluate as well (repeatable)")
        ->allow_extra_args(false);
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command
        ->add_option("--evaluate", arguments->evaluation,
                     "Where to evaluate: by the plugin on the CPU, or its GLSL on the device")
        ->check(CLI::IsMember({"auto", "cpu", "device"}))
        ->capture_default_str();
    command->add_option("--device", arguments->device, "Device for --evaluate device: name or index");
    command->add_flag("--json", arguments->json, "Print JSON");
    command->callback([arguments] { run(*arguments); });
}

} // namespace elvis::commands
