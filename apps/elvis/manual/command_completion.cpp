// Scripts that complete words of the command line, from what the parser knows.

#include "command_facts.hpp"
#include <apps/elvis/commands.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : " ") + word;
    }
    return text;
}

/** In single quotes, as all three shells read it. */
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) {
        result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    }
    return result + "'";
}

/** What can stand where no value is wanted: options, commands, and arguments of which there are few. */
std::string words_of(const CommandFacts& command) {
    std::vector<std::string> words;
    for (const OptionFacts& option : command.options) {
        const std::vector<std::string>& some = option.is_positional() ? option.choices : option.names;
        words.insert(words.end(), some.begin(), some.end());
    }
    return joined(words);
}

std::string names_of(const std::vector<CommandFacts>& commands) {
    std::vector<std::string> names;
    for (const CommandFacts& command : commands) {
        names.push_back(command.name);
    }
    return joined(names);
}

std::string bash_script(const CommandFacts& program, const std::vector<CommandFacts>& commands) {
    std::string values, words = "    '') words=" + quoted(names_of(commands) + " " + words_of(program)) + " ;;\n";
    for (const CommandFacts& command : commands) {
        const bool wants_command = command.name == "help";
        words += "    " + command.name +
                 ") words=" + quoted((wants_command ? names_of(commands) + " " : "") + words_of(command)) + " ;;\n";
        for (const OptionFacts& option : command.options) {
            for (const std::string& name :
                 option.is_positional() || !option.has_value ? std::vector<std::string>{} : option.names) {
                values += "    " + quoted(command.name + " " + name) + ") words=" + quoted(joined(option.choices)) + " ;;\n";
            }
        }
    }
    return R"(# Completes words of elvis in bash; elvis completion bash prints it.
_elvis() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command='' words='' i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        if [[ ${COMP_WORDS[i]} != -* ]]; then
            command=${COMP_WORDS[i]}
            break
        fi
    done
    case "$command $before" in
)" + values +
           R"(    *)
    case $command in
)" + words +
           R"(    esac
    # Names of files come first where no option was begun.
    if [[ $word != -* && -n $command && $words == -* ]]; then
        words=''
    fi ;;
    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _elvis elvis
)";
}

/** Of zsh's _arguments, where brackets and colons have a meaning. */
std::string zsh_text(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        result += (letter == '[' || letter == ']' || letter == ':' || letter == '\\' ? "\\" : "") + std::string(1, letter);
    }
    return result;
}

std::string zsh_values(const OptionFacts& option) {
    return option.choices.empty() ? ":value:_files" : ":value:(" + joined(option.choices) + ")";
}

std::string zsh_arguments(const CommandFacts& command) {
    std::string text = "_arguments -s";
    for (const OptionFacts& option : command.options) {
        if (option.is_positional()) {
            text += " \\\n            " + quoted((option.is_repeatable ? "*" : "") + zsh_values(option));
            continue;
        }
        for (const std::string& name : option.names) {
            text += " \\\n            " + quoted((option.is_repeatable ? "*" : "") + name + "[" + zsh_text(option.about) + "]" +
                                                 (option.has_value ? zsh_values(option) : ""));
        }
    }
    return text;
}

std::string zsh_script(const CommandFacts& program, const std::vector<CommandFacts>& commands) {
    std::string list, cases;
    for (const CommandFacts& command : commands) {
        list += "        " + quoted(zsh_text(command.name) + ":" + zsh_text(command.about)) + "\n";
        cases += "    " + command.name + ")\n        " +
                 (command.name == "help" ? "_describe command commands" : zsh_arguments(command)) + " ;;\n";
    }
    return "#compdef elvis\n# Completes words of elvis in zsh; elvis completion zsh prints it.\n_elvis() {\n"
           "    local -a commands\n    commands=(\n" +
           list +
           "    )\n    if ((CURRENT == 2)) && [[ $PREFIX != -* ]]; then\n        _describe command commands\n"
           "        return\n    fi\n    local command=$words[2]\n    shift words\n    ((CURRENT--))\n    case $command in\n" +
           cases + "    *)\n        " + zsh_arguments(program) +
           " ;;\n    esac\n}\n"
           // Read as a file it is only told; autoloaded it is the function's first call.
           "if [[ $funcstack[1] == _elvis ]]; then\n    _elvis \"$@\"\nelse\n    compdef _elvis elvis\nfi\n";
}

std::string fish_option(const std::string& condition, const OptionFacts& option) {
    std::string text = "complete -c elvis -n " + quoted(condition);
    for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    text += option.has_value ? (option.choices.empty() ? " -r" : " -x -a " + quoted(joined(option.choices))) : "";
    return text + " -d " + quoted(option.about) + "\n";
}

std::string fish_script(const CommandFacts& program, const std::vector<CommandFacts>& commands) {
    std::string text = "# Completes words of elvis in fish; elvis completion fish prints it.\n";
    for (const OptionFacts& option : program.options) {
        text += fish_option("__fish_use_subcommand", option);
    }
    for (const CommandFacts& command : commands) {
        text += "complete -c elvis -f -n __fish_use_subcommand -a " + command.name + " -d " + quoted(command.about) + "\n";
        for (const OptionFacts& option : command.options) {
            if (!option.is_positional()) {
                text += fish_option("__fish_seen_subcommand_from " + command.name, option);
            } else if (!option.choices.empty()) {
                text += "complete -c elvis -f -n " + quoted("__fish_seen_subcommand_from " + command.name) + " -a " +
                        quoted(joined(option.choices)) + "\n";
            }
        }
    }
    return text;
}

} // namespace

void add_completion(CLI::App& app) {
    CLI::App* command = app.add_subcommand("completion", "Print the script with which a shell completes words of elvis");
    command->group("");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->callback([&app, shell] {
        const auto script = *shell == "bash" ? bash_script : *shell == "zsh" ? zsh_script : fish_script;
        std::printf("%s", script(facts_of(app), facts_of_commands(app)).c_str());
    });
}

} // namespace elvis::commands
