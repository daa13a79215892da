#include <apps/elvis/commands.hpp>
#include <apps/elvis/unknown_word.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

void add_help(CLI::App& app) {
    CLI::App* command = app.add_subcommand("help", "Print the help of a command, or the list of all");
    auto name = std::make_shared<std::string>();
    command->add_option("command", *name, "Command that the help is of");
    command->callback([&app, name] {
        // The program's own help would be that of the command that is running: this one.
        const std::string text = name->empty()
                                     ? app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal)
                                     : need_command(app, *name).help(app.get_name());
        std::printf("%s", text.c_str());
    });
}

void add_version(CLI::App& app) {
    CLI::App* command = app.add_subcommand("version", "Print the version");
    command->callback([] { std::printf("elvis %s\n", ELVIS_VERSION); });
}

} // namespace elvis::commands
