/**
 * @file command_facts.hpp
 * What the parser knows of the commands: what texts about them are made of, so that these never go stale.
 */
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace elvis::commands {

struct OptionFacts {
    /** "-o", "--output"; of an argument without dashes its name. */
    std::vector<std::string> names;
    std::string about;
    /** All that it can be, where these are few. */
    std::vector<std::string> choices;
    bool has_value = false;
    bool is_repeatable = false;

    bool is_positional() const { return names.front().front() != '-'; }
};

struct CommandFacts {
    /** Empty for the program itself. */
    std::string name;
    std::string about;
    /** Arguments without dashes first. */
    std::vector<OptionFacts> options;
};

/** Options that are not hidden. */
CommandFacts facts_of(const CLI::App& command);
/** The commands that are not hidden, by name. */
std::vector<CommandFacts> facts_of_commands(const CLI::App& app);

} // namespace elvis::commands
