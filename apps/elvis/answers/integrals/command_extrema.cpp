#include "answers_as_json.hpp"
#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/error.hpp>

#include <cstdio>
#include <memory>
#include <string>

namespace elvis::commands {
namespace {

struct ExtremaArguments {
    VolumeArguments volume;
    std::string field;
    std::string device;
    std::uint32_t time_step = 0;
};

void run_extrema(const ExtremaArguments& arguments) {
    const context library = library_context(arguments.device);
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    if (volume.info().n_fields == 0 && arguments.field.empty()) {
        throw Error(arguments.volume.files.front(), "has no fields");
    }
    const std::string field = arguments.field.empty() ? volume.field(0).name : arguments.field;
    const auto answer = extrema_json(field, volume.range(field, arguments.time_step));
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
