// Manual pages in troff's macros "man", from what the parser knows.

#include "command_facts.hpp"
#include <apps/elvis/commands.hpp>
#include <apps/elvis/unknown_word.hpp>

#include <core/base/output_file.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace elvis::commands {

namespace {

/** Plain text: nothing in it is a request or an escape. */
std::string plain(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        result += letter == '\\' ? std::string("\\e") : letter == '-' ? std::string("\\-") : std::string(1, letter);
    }
    return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    return text;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : between) + word;
    }
    return text;
}

std::string option_text(const OptionFacts& option) {
    std::string text = ".TP\n\\fB" + plain(joined(option.names, ", ")) + "\\fR";
    text += option.has_value && !option.is_positional() ? " \\fIvalue\\fR" : "";
    const std::string choices = option.choices.empty() ? "" : " (" + joined(option.choices, ", ") + ")";
    return text + "\n" + plain(option.about + choices) + "\n";
}

std::string head(const std::string& name, const std::string& about) {
    return ".TH " + upper(plain(name)) + " 1 \"\" \"ElVis " ELVIS_VERSION "\" \"ElVis\"\n.ad l\n.SH NAME\n" + plain(name) +
           " \\- " + plain(about) + "\n";
}

std::string list_of_options(const CommandFacts& command) {
    std::string text = ".SH OPTIONS\n";
    for (const OptionFacts& option : command.options) {
        text += option_text(option);
    }
    return text;
}

/** Of the program: its commands, and what they have in common. */
std::string program_page(const CLI::App& app) {
    const CommandFacts program = facts_of(app);
    std::string text =
        head("elvis", program.about) + ".SH SYNOPSIS\n\\fBelvis\\fR [\\fIoptions\\fR] \\fIcommand\\fR ...\n.SH COMMANDS\n";
    std::string pages;
    for (const CommandFacts& command : facts_of_commands(app)) {
        text += ".TP\n\\fB" + plain(command.name) + "\\fR\n" + plain(command.about) + "\n";
        pages += (pages.empty() ? "" : " ,\n") + (".BR elvis\\-" + plain(command.name) + " (1)");
    }
    return text + list_of_options(program) +
           ".SH EXIT STATUS\n0 if everything asked for was done, 2 for wrong usage, 1 for anything else.\n.SH SEE ALSO\n" +
           pages + "\n";
}

std::string command_page(const CommandFacts& command) {
    std::string text = head("elvis-" + command.name, command.about) + ".SH SYNOPSIS\n\\fBelvis " + plain(command.name) +
                       "\\fR [\\fIoptions\\fR]";
    for (const OptionFacts& option : command.options) {
        text += option.is_positional() ? " \\fI" + plain(option.names.front()) + "\\fR" + (option.is_repeatable ? " ..." : "")
                                       : std::string();
    }
    return text + "\n" + list_of_options(command) + ".SH SEE ALSO\n.BR elvis (1)\n";
}

void write_all(const CLI::App& app, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_text_file((folder / "elvis.1").string(), program_page(app));
    for (const CommandFacts& command : facts_of_commands(app)) {
        write_text_file((folder / ("elvis-" + command.name + ".1")).string(), command_page(command));
    }
}

} // namespace

void add_manual(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("manual", "Print the manual page of a command, or of the program, as troff reads it");
    command->group("");
    auto name = std::make_shared<std::string>();
    auto folder = std::make_shared<std::string>();
    command->add_option("command", *name, "Command that the page is of");
    command->add_option("--write-all", *folder, "Write all pages into this folder");
    command->callback([&app, name, folder] {
        if (!folder->empty()) {
            write_all(app, *folder);
        } else {
            const std::string text = name->empty() ? program_page(app) : command_page(facts_of(need_command(app, *name)));
            std::printf("%s", text.c_str());
        }
    });
}

} // namespace elvis::commands
