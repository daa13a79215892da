#include "commands.hpp"
#include "library_context.hpp"
#include "open_volume.hpp"
#include <apps/serve/serve.hpp>

#include <core/base/error.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

struct ServeArguments {
    serve::Options options;
    std::string device;
};

void run_serve([[maybe_unused]] const ServeArguments& arguments) {
#ifdef ELVIS_HAS_SERVE
    serve::run(library_context(arguments.device), arguments.options, open_watched, [](const std::string& url) {
        std::printf("%s\n", url.c_str());
        std::fflush(stdout);
    });
#else
    throw Error("elvis serve",
                "was left out of this program: it is built where libturbojpeg0-dev and node-typescript are installed");
#endif
}

} // namespace

void add_serve(CLI::App& app) {
    CLI::App* command = app.add_subcommand("serve", "Look at a volume in a browser: prints the address of the page");
    auto a = std::make_shared<ServeArguments>();
    command->add_option("input", a->options.files, "Scene, or volume, whatever its format (geometry first, then field files)")
        ->required();
    command->add_option("--port", a->options.port, "Of the address; 8080 by default, 0: one that is free");
    command->add_option("--address", a->options.address,
                        "Which network may come: 127.0.0.1, this machine alone, by default; 0.0.0.0: all, without encryption");
    command->add_option("--origin", a->options.origins, "Where else pages may come from, such as https://host behind a proxy");
    command->add_option("--root", a->options.root,
                        "Folder with the files that scenes may name, such as colour maps; by default that of the input");
    command->add_option("--sessions", a->options.most_sessions, "How many people may look at the same time; 8 by default")
        ->check(CLI::Range(1, 1000));
    command
        ->add_option("--memory", a->options.most_memory,
                     "Mebibytes that the volume and all sessions may take together; what needs more is refused")
        ->check(CLI::Range(1, 1 << 30));
    command->add_flag("--until-input-ends", a->options.ends_with_input,
                      "End when the standard input does, and so with the program that has started the server");
    command->add_option("--device", a->device,
                        "Name (or part of it), index, PCI bus id or UUID of the Vulkan device that draws");
    command->callback([a] { run_serve(*a); });
}

} // namespace elvis::commands
