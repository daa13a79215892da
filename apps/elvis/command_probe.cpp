#include "commands.hpp"
#include "library_context.hpp"
#include "open_volume.hpp"
#include "volume_arguments.hpp"

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/vector3.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace elvis::commands {
namespace {

struct ProbeArguments {
    VolumeArguments volume;
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

void read_points(const std::string& path, std::vector<double>& positions) {
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
        positions.insert(positions.end(), position->begin(), position->end());
    }
    if (file.bad())
        throw Error(path, "cannot be read");
}

/** Three numbers a point. */
std::vector<double> positions_of(const ProbeArguments& arguments) {
    std::vector<double> positions;
    for (const std::string& text : arguments.points) {
        const std::optional<Vector3> position = parse_position(text);
        if (!position)
            throw UsageError("--point", "expected x,y,z, found '" + text + "'");
        positions.insert(positions.end(), position->begin(), position->end());
    }
    if (!arguments.points_file.empty())
        read_points(arguments.points_file, positions);
    else if (positions.empty())
        throw UsageError("elvis probe", "needs --point x,y,z or --points FILE");
    return positions;
}

/** Answers of the library, point by point. */
class Answers {
public:
    /** What is asked for: all fields, then the expressions. */
    Answers(const data& volume, const ProbeArguments& arguments, const std::vector<double>& positions)
        : m_positions(positions) {
        const std::uint32_t n_fields = volume.info().n_fields;
        for (std::uint32_t index = 0; index < n_fields; ++index) {
            const elvis_field field = volume.field(index);
            m_columns.push_back({field.name, field.unit, field.n_components, m_n_values});
            m_n_values += field.n_components;
        }
        m_n_fields = m_columns.size();
        for (const std::string& text : arguments.expressions)
            m_columns.push_back({text, "", 1, m_n_values++});
        ask(volume, arguments);
    }

    struct Column {
        std::string name, unit;
        std::uint32_t n_values = 1;
        /** Of the first value, among those of a point. */
        std::uint32_t first = 0;
    };
    std::span<const Column> fields() const { return std::span(m_columns).first(m_n_fields); }
    std::span<const Column> expressions() const { return std::span(m_columns).subspan(m_n_fields); }

    std::size_t n_points() const { return m_elements.size(); }
    std::array<double, 3> position(std::size_t point) const { return triple(m_positions, point); }
    std::array<double, 3> xi(std::size_t point) const { return triple(m_xi, point); }
    bool is_inside(std::size_t point) const { return m_elements[point] >= 0; }
    bool is_unknown(std::size_t point) const { return m_elements[point] == -2; }
    std::int64_t element(std::size_t point) const { return m_elements[point]; }
    std::uint32_t n_failures(std::size_t point) const { return m_failures[point]; }
    std::vector<std::int64_t> also(std::size_t point) const {
        const std::span<const std::int64_t> all = std::span(m_also).subspan(point * most_also, most_also);
        return {all.begin(), std::ranges::find(all, -1)};
    }
    double value(std::size_t point, const Column& column, std::size_t component) const {
        return m_values[point * m_n_values + column.first + component];
    }
    std::array<double, 3> gradient(std::size_t point, const Column& column, std::size_t component) const {
        return triple(m_gradients, point * m_n_values + column.first + component);
    }
    bool is_estimated(std::size_t point, const Column& column, std::uint32_t what) const {
        return (m_estimated[point * m_n_values + column.first] & what) != 0;
    }

private:
    /** More elements than that do not meet in one point of any mesh that is drawn. */
    static constexpr std::uint32_t most_also = 256;

    static std::array<double, 3> triple(const std::vector<double>& numbers, std::size_t index) {
        return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
    }

    void ask(const data& volume, const ProbeArguments& arguments) {
        const std::size_t n = m_positions.size() / 3;
        m_elements.resize(n);
        m_failures.resize(n);
        m_also.resize(most_also * n);
        m_xi.resize(3 * n);
        m_values.resize(m_n_values * n);
        m_gradients.resize(3 * m_n_values * n);
        m_estimated.resize(m_n_values * n);
        std::vector<elvis_string> names;
        for (const Column& column : m_columns)
            names.push_back(column.name.c_str());
        auto probe = detail::sized<elvis_probe>();
        probe.time_step = arguments.time_step;
        probe.n_points = n;
        probe.positions = m_positions.data();
        probe.n_fields = static_cast<std::uint32_t>(names.size());
        probe.fields = names.data();
        probe.elements = m_elements.data();
        probe.xi = m_xi.data();
        probe.values = m_values.data();
        probe.gradients = m_gradients.data();
        probe.estimated = m_estimated.data();
        probe.also = m_also.data();
        probe.most_also = most_also;
        probe.n_failures = m_failures.data();
        probe.evaluation = arguments.evaluation == "cpu"      ? ELVIS_EVALUATION_CPU
                           : arguments.evaluation == "device" ? ELVIS_EVALUATION_DEVICE
                                                              : ELVIS_EVALUATION_AUTOMATIC;
        volume.probe(probe);
    }

    std::vector<Column> m_columns;
    std::size_t m_n_fields = 0;
    /** A point's. */
    std::uint32_t m_n_values = 0;
    std::vector<double> m_positions, m_xi, m_values, m_gradients;
    std::vector<std::int64_t> m_elements, m_also;
    std::vector<std::uint32_t> m_failures;
    std::vector<std::uint8_t> m_estimated;
};

nlohmann::ordered_json json_of(const Answers& answers, std::size_t point) {
    nlohmann::ordered_json answer;
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    nlohmann::ordered_json gradients = nlohmann::ordered_json::object();
    const bool is_inside = answers.is_inside(point);
    bool is_estimated = false;
    for (const Answers::Column& field : answers.fields()) {
        for (std::size_t c = 0; is_inside && c < field.n_values; ++c) {
            values[field.name].push_back(answers.value(point, field, c));
            gradients[field.name].push_back(answers.gradient(point, field, c));
        }
        is_estimated = is_estimated || answers.is_estimated(point, field, ELVIS_ESTIMATED_GRADIENT);
    }
    answer["x"] = answers.position(point);
    answer["element"] = is_inside ? nlohmann::ordered_json(answers.element(point)) : nlohmann::ordered_json();
    answer["xi"] = is_inside ? nlohmann::ordered_json(answers.xi(point)) : nlohmann::ordered_json();
    answer["fields"] = std::move(values);
    answer["gradients"] = std::move(gradients);
    answer["also"] = answers.also(point);
    answer["gradients_estimated"] = is_estimated;
    if (!answers.expressions().empty()) {
        answer["expressions"] = nlohmann::ordered_json::object();
        for (const Answers::Column& expression : answers.expressions()) {
            if (is_inside) {
                answer["expressions"][expression.name] = {
                    {"value", answers.value(point, expression, 0)},
                    {"gradient", answers.gradient(point, expression, 0)},
                    {"value_estimated", answers.is_estimated(point, expression, ELVIS_ESTIMATED_VALUE)},
                    {"gradient_estimated", answers.is_estimated(point, expression, ELVIS_ESTIMATED_GRADIENT)}};
            }
        }
    }
    answer["newton_failures"] = answers.n_failures(point);
    return answer;
}

void print_json(const Answers& answers) {
    nlohmann::ordered_json document = {{"points", nlohmann::ordered_json::array()}};
    for (std::size_t point = 0; point < answers.n_points(); ++point)
        document["points"].push_back(json_of(answers, point));
    std::printf("%s\n", document.dump(2).c_str());
}

void print_value(const Answers& answers, std::size_t point, const Answers::Column& column, std::size_t component) {
    const auto word = [&](std::uint32_t what) { return answers.is_estimated(point, column, what) ? ", estimated" : ""; };
    const std::array<double, 3> gradient = answers.gradient(point, column, component);
    std::string name = column.name;
    if (column.n_values > 1)
        name.append("[").append(std::to_string(component)).append("]");
    std::printf("  %s = %.17g%s%s%s, gradient (%.17g, %.17g, %.17g)%s\n", name.c_str(), answers.value(point, column, component),
                column.unit.empty() ? "" : " ", column.unit.c_str(), word(ELVIS_ESTIMATED_VALUE), gradient[0], gradient[1],
                gradient[2], word(ELVIS_ESTIMATED_GRADIENT));
}

void print_table(const Answers& answers) {
    for (std::size_t point = 0; point < answers.n_points(); ++point) {
        const std::array<double, 3> x = answers.position(point), xi = answers.xi(point);
        std::printf("x = (%.17g, %.17g, %.17g)\n", x[0], x[1], x[2]);
        if (!answers.is_inside(point)) {
            std::printf("  in no element\n");
            continue;
        }
        std::printf("  element %lld", static_cast<long long>(answers.element(point)));
        const char* separator = ", also ";
        for (const std::int64_t other : answers.also(point)) {
            std::printf("%s%lld", separator, static_cast<long long>(other));
            separator = ", ";
        }
        std::printf("\n  xi = (%.17g, %.17g, %.17g)\n", xi[0], xi[1], xi[2]);
        for (const Answers::Column& field : answers.fields())
            for (std::size_t component = 0; component < field.n_values; ++component)
                print_value(answers, point, field, component);
        for (const Answers::Column& expression : answers.expressions())
            print_value(answers, point, expression, 0);
    }
}

void run_probe(const ProbeArguments& arguments) {
    const std::vector<double> positions = positions_of(arguments);
    const context library = library_context(arguments.device);
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    const Answers answers(volume, arguments, positions);
    arguments.json ? print_json(answers) : print_table(answers);
    std::size_t n_unknown = 0;
    for (std::size_t point = 0; point < answers.n_points(); ++point)
        n_unknown += answers.is_unknown(point);
    if (n_unknown > 0)
        throw Error(arguments.volume.files.front(), "the inverse mapping failed at " + counted(n_unknown, "point") +
                                                        ": whether they lie in the volume is not known");
}

} // namespace

void add_probe(CLI::App& app) {
    auto arguments = std::make_shared<ProbeArguments>();
    CLI::App* command =
        app.add_subcommand("probe", "Print element, reference coordinates and fields at points, in double precision");
    add_volume_arguments(*command, arguments->volume);
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
    command->callback([arguments] { run_probe(*arguments); });
}

} // namespace elvis::commands
