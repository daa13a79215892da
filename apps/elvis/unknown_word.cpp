#include "unknown_word.hpp"

#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>

#include <algorithm>
#include <cctype>

namespace elvis::commands {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

/** The name of "--name=value"; empty for words that are no options, such as numbers. */
std::string option_name(const std::string& word) {
    const bool is_option =
        word.size() > 1 && word[0] == '-' && (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])));
    return is_option && word != "--" ? word.substr(0, word.find('=')) : std::string();
}

/** "-o5" is the option -o with a value, "-vq" two without. */
bool is_known(const std::string& name, const std::vector<std::string>& known) {
    return std::ranges::find(known, name[1] == '-' ? name : name.substr(0, 2)) != known.end();
}

void add_names(const CLI::App& command, std::vector<std::string>& names) {
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_snames()) {
            names.push_back("-" + name);
        }
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
}

} // namespace

const CLI::App& need_command(const CLI::App& app, const std::string& name) {
    std::vector<std::string> known;
    for (const CLI::App* command : commands_of(app)) {
        if (command->get_name() == name) {
            return *command;
        }
        if (!command->get_group().empty()) {
            known.push_back(command->get_name());
        }
    }
    throw UsageError(name, "is no command; the nearest is '" + nearest_word(name, known) + "', and elvis --help lists all");
}

std::optional<std::string> unknown_option(const CLI::App& app, const std::vector<std::string>& words) {
    std::vector<std::string> known;
    add_names(app, known);
    std::string help = "elvis --help";
    bool has_command = false;
    for (const std::string& word : words) {
        const std::string name = option_name(word);
        if (!name.empty() && !is_known(name, known)) {
            std::vector<std::string> alike = known;
            std::erase_if(alike, [](const std::string& one) { return one[1] != '-'; });
            const std::string hint = name[1] == '-' ? "; did you mean " + nearest_word(name, alike) + "?" : ";";
            return "unknown option " + name + hint + " " + help + " lists all";
        }
        if (name.empty() && !has_command) {
            has_command = true;
            help = "elvis " + word + " --help";
            add_names(need_command(app, word), known);
        }
    }
    return std::nullopt;
}

} // namespace elvis::commands
