/**
 * @file host.hpp
 * What the program around this library decides for it: where log lines and cached files go, and what the environment may say.
 */
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

enum class LogLevel { debug, info, warning, error };

/** Members are read from several threads at once, and do not change while anything uses them. */
struct Host {
    /** Called with each line, from any thread, also from several at once. Empty: no one listens. */
    std::function<void(LogLevel level, std::string_view line)> log;
    /** Whether variables of the environment ($ELVIS_..., $XDG_..., $HOME) have a say in what is not decided here. */
    bool reads_environment = true;
    /** Where compiled kernels are kept; an empty path: nowhere. */
    std::optional<std::filesystem::path> cache_folder;
    /** Where plugins are looked for, in this order. */
    std::optional<std::vector<std::filesystem::path>> plugin_folders;
};

/** Folders of a list that ':' separates; empty ones are left out. */
std::vector<std::filesystem::path> split_folders(std::string_view list);

/** The one that this thread works for: that of the innermost HostScope, else the program's own. */
const Host& host();

/** The program's own: silent, and with the environment, unless it says otherwise before other threads start. */
Host& program_host();

/** While it lives, this thread works for a host, which must outlive it. */
class HostScope {
public:
    explicit HostScope(const Host& host);
    ~HostScope();
    HostScope(const HostScope&) = delete;
    HostScope& operator=(const HostScope&) = delete;

private:
    const Host* m_before;
};

/** A variable of the environment; nothing if it is not set, empty, or not to be read. */
std::optional<std::string> environment_variable(const char* name);

} // namespace elvis
