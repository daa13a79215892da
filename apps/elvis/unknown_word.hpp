/**
 * @file unknown_word.hpp
 * Messages about commands and options that there are not, with the nearest that there is.
 */
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

/** Throws UsageError if there is no command of that name. */
const CLI::App& need_command(const CLI::App& app, const std::string& name);

/** What to say of the first word that looks like an option and is none, in words that the parser refused; nothing if all are.
 */
std::optional<std::string> unknown_option(const CLI::App& app, const std::vector<std::string>& words);

} // namespace elvis::commands
