#include "command_facts.hpp"

#include <algorithm>
#include <sstream>

namespace elvis::commands {

namespace {

/** Of "TEXT:{a,b}", as the parser calls what can be a or b. */
std::vector<std::string> choices_in(const std::string& type) {
    const std::size_t begin = type.find('{'), end = type.find('}');
    std::vector<std::string> choices;
    if (begin != std::string::npos && end != std::string::npos) {
        std::istringstream list(type.substr(begin + 1, end - begin - 1));
        for (std::string choice; std::getline(list, choice, ',');) {
            choices.push_back(choice);
        }
    }
    return choices;
}

OptionFacts facts_of_option(const CLI::Option& option) {
    OptionFacts facts;
    for (const std::string& name : option.get_snames()) {
        facts.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        facts.names.push_back("--" + name);
    }
    if (facts.names.empty()) {
        facts.names.push_back(option.get_name(true));
    }
    facts.about = option.get_description();
    facts.has_value = option.get_items_expected_max() > 0;
    facts.choices = facts.has_value ? choices_in(option.get_type_name()) : std::vector<std::string>{};
    facts.is_repeatable = facts.has_value && option.get_items_expected_max() > 1;
    return facts;
}

} // namespace

CommandFacts facts_of(const CLI::App& command) {
    CommandFacts facts;
    facts.name = command.get_parent() != nullptr ? command.get_name() : std::string();
    facts.about = command.get_description();
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_group().empty()) {
            facts.options.push_back(facts_of_option(*option));
        }
    }
    std::stable_partition(facts.options.begin(), facts.options.end(),
                          [](const OptionFacts& option) { return option.is_positional(); });
    return facts;
}

std::vector<CommandFacts> facts_of_commands(const CLI::App& app) {
    std::vector<CommandFacts> all;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
        all.push_back(facts_of(*command));
    }
    std::ranges::sort(all, {}, &CommandFacts::name);
    return all;
}

} // namespace elvis::commands
