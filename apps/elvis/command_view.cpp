#include "commands.hpp"
#include <apps/elvis/view/window/application.hpp>

#include <core/base/error.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

struct ViewArguments {
    view::Options options;
    std::string size;
};

void run_view(ViewArguments arguments) {
    if (!arguments.size.empty()) {
        int width = 0, height = 0, used = 0;
        if (std::sscanf(arguments.size.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
            static_cast<std::size_t>(used) != arguments.size.size() || width < 400 || height < 300 || width > 16384 ||
            height > 16384) {
            throw UsageError("--size", "'" + arguments.size + "' is not WIDTHxHEIGHT from 400x300 to 16384x16384");
        }
        arguments.options.size = {width, height};
    }
    view::run(arguments.options);
}

} // namespace

void add_view(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Look at a volume in a window");
    auto a = std::make_shared<ViewArguments>();
    command->add_option("input", a->options.files, "Scene, or volume, whatever its format (geometry first, then field files)");
    command->add_option("--device", a->options.device,
                        "Name (or part of it), index, PCI bus id or UUID of the Vulkan device that draws");
    command->add_option("--size", a->size, "WIDTHxHEIGHT of the window");
    command->add_option("--text-scale", a->options.text_scale, "Size of texts and controls, times what the screen asks for")
        ->check(CLI::Range(0.5, 4.0));
    command->add_flag("--validation", a->options.validation, "Run with the Vulkan validation layer; any message is an error");
    command->add_option("--describe", a->options.description,
                        "For tests: a file that tells, as JSON, what is on the screen and where");
    command->callback([a] { run_view(*a); });
}

} // namespace elvis::commands
