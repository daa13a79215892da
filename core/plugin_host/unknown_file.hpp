/**
 * @file unknown_file.hpp
 * What to say of a file that no plugin reads.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <string>

namespace elvis {

/** What a file seems to be by its first bytes and its name, and what could be done with it. Empty: no idea. */
struct FileGuess {
    std::string kind;
    std::string advice;
};
FileGuess guess_file(const std::string& path);

/** The message: what it seems to be, which format would do, and what plugins said. `refusal`: of the registry. */
Error unknown_file(const PluginRegistry& registry, const std::string& path, const Error& refusal);

} // namespace elvis
