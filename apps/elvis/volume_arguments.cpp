#include "volume_arguments.hpp"

#include <apps/elvis/open_volume.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <list>

namespace elvis::commands {

void add_warp(CLI::App& command, WarpArguments& arguments) {
    CLI::Option* const field =
        command.add_option("--warp", arguments.field,
                           "Displace the geometry by this vector field; in two dimensions also by a number, which is a height");
    command.add_option("--warp-factor", arguments.factor, "Times which the displacement is taken; default: 1")->needs(field);
    command.add_option("--warp-imaginary", arguments.imaginary, "Imaginary part of a complex displacement")->needs(field);
    command
        .add_option("--warp-phase", arguments.phase,
                    "Degrees: of the complex displacement times e^(i phase) the real part is taken")
        ->needs(field);
}

namespace {

data warped(data volume, const WarpArguments& arguments, std::uint32_t time_step) {
    if (arguments.field.empty()) {
        return volume;
    }
    auto how = detail::sized<elvis_warp>();
    how.time_step = time_step;
    how.field = arguments.field.c_str();
    how.imaginary = detail::or_null(arguments.imaginary);
    how.factor = arguments.factor;
    how.phase = arguments.phase;
    return open_watched([&](const task& watch) { return volume.warp(how, watch); });
}

/** The files are opened, and closed when all is joined. */
data joined(const context& library, data volume, const std::vector<std::string>& joins) {
    if (joins.empty()) {
        return volume;
    }
    std::list<data> opened;
    std::vector<data::joined> others;
    for (const std::string& text : joins) {
        const JoinArgument join = parse_join(text);
        const data* from = &volume;
        if (!join.file.empty()) {
            from =
                &opened.emplace_back(open_watched([&](const task& watch) { return library.open(join.file, {}, {}, watch); }));
        }
        others.push_back({join.name, from, join.time_step.value_or(ELVIS_SAME_TIME_STEP)});
    }
    return open_watched([&](const task& watch) { return volume.join(others, watch); });
}

} // namespace

JoinArgument parse_join(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw UsageError("--join", "'" + text + "' is not NAME=FILE, NAME=FILE@STEP or NAME=@STEP");
    }
    JoinArgument join{text.substr(0, equals), text.substr(equals + 1), std::nullopt};
    const std::size_t at = join.file.rfind('@');
    std::uint32_t time_step = 0;
    const char* const end = join.file.data() + join.file.size();
    // A file's name may have an @ that no number follows.
    if (at != std::string::npos && std::from_chars(join.file.data() + at + 1, end, time_step).ptr == end &&
        at + 1 < join.file.size()) {
        join.time_step = time_step;
        join.file.resize(at);
    }
    if (join.file.empty() && !join.time_step) {
        throw UsageError("--join", "'" + text + "' names neither a file nor a time step");
    }
    return join;
}

void add_join(CLI::App& command, std::vector<std::string>& joins) {
    command
        .add_option("--join", joins,
                    "NAME=FILE[@STEP]: fields of another volume, as NAME.FIELD; NAME=@STEP: of this one at "
                    "another time step (repeatable)")
        ->allow_extra_args(false);
}

void add_volume_arguments(CLI::App& command, VolumeArguments& arguments) {
    command.add_option("volume", arguments.files, "Volume, whatever its format (geometry first, then field files)")->required();
    command.add_option("--plugin", arguments.plugin, "Plugin by id; default: the one surest of the file");
    add_join(command, arguments.joins);
    add_warp(command, arguments.warp);
}

data open_volume(const context& library, const VolumeArguments& arguments, std::uint32_t time_step) {
    data volume = open_watched([&](const task& watch) { return library.open(arguments.files, arguments.plugin, {}, watch); });
    return warped(joined(library, std::move(volume), arguments.joins), arguments.warp, time_step);
}

} // namespace elvis::commands
