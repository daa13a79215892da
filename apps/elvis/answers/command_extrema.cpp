#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/error.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {
namespace {

struct ExtremaArguments {
    VolumeArguments volume;
    std::string field;
    std::string device;
    std::uint32_t time_step = 0;
};

/** `bound`: beyond it lies no value, if it is certified. */
nlohmann::ordered_json extremum(double value, double bound, bool is_certified, std::int64_t element, const double* xi,
                                const double* position) {
    nlohmann::ordered_json answer = {{"value", value}};
    if (is_certified) {
        answer["interval"] = {std::min(value, bound), std::max(value, bound)};
    }
    answer["element"] = element;
    answer["xi"] = std::array{xi[0], xi[1], xi[2]};
    if (std::isfinite(position[0])) {
        answer["position"] = std::array{position[0], position[1], position[2]};
    }
    return answer;
}

void run_extrema(const ExtremaArguments& arguments) {
    const context library = library_context(arguments.device);
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    if (volume.info().n_fields == 0 && arguments.field.empty()) {
        throw Error(arguments.volume.files.front(), "has no fields");
    }
    const std::string field = arguments.field.empty() ? volume.field(0).name : arguments.field;
    const elvis_range range = volume.range(field, arguments.time_step);
    if (!std::isfinite(range.minimum) || !std::isfinite(range.maximum)) {
        throw Error(field, "is not finite everywhere: it has no extrema");
    }
    const bool is_certified = range.certainty == ELVIS_CERTIFIED;
    const nlohmann::ordered_json answer = {
        {"field", field},
        {"certainty", is_certified ? "certified" : "sampled"},
        {"minimum", extremum(range.minimum, range.lower_bound, is_certified, range.minimum_element, range.minimum_xi,
                             range.minimum_position)},
        {"maximum", extremum(range.maximum, range.upper_bound, is_certified, range.maximum_element, range.maximum_xi,
                             range.maximum_position)}};
    std::printf("%s\n", answer.dump(2).c_str());
}

} // namespace

void add_extrema(CLI::App& app) {
    auto arguments = std::make_shared<ExtremaArguments>();
    CLI::App* command = app.add_subcommand(
        "extrema", "Print a field's smallest and largest value, where they are, and what certainly holds them");
    add_volume_arguments(*command, arguments->volume);
    command->add_option("--field", arguments->field,
                        "Field, component or expression; of a vector its magnitude; default: the first field");
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command->add_option("--device", arguments->device, "Device that samples expressions: name or index");
    command->callback([arguments] { run_extrema(*arguments); });
}

} // namespace elvis::commands
