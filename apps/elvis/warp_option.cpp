#include "warp_option.hpp"

#include <apps/elvis/open_volume.hpp>

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

} // namespace elvis::commands
