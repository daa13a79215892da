/**
 * @file request.hpp
 * A whole conversion, from file names to the native volume, here or in a process of its own.
 */
#pragma once

#include <core/convert/convert.hpp>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct ConvertRequest {
    /** Geometry first, then field files. */
    std::vector<std::string> inputs;
    std::string output;
    /** Id of the conversion plugin; empty: the one surest of the first input. */
    std::string plugin;
    /** JSON; may be empty. */
    std::string plugin_options;
    ConvertOptions options;
};

/**
 * In this process, or together with others. `on_plugin`, if there is one, is told the plugin's id before its volume is opened.
 */
ConvertReport convert(const ConvertRequest& request, const TaskControl& control,
                      const std::function<void(const std::string& id)>& on_plugin = {}, Team* team = nullptr);

/** How a process that converts is treated. */
struct ConvertProcess {
    /** Descriptor to which it writes warnings, and plugins whatever they print. */
    int output = 2;
    /** It is ended when it takes more main memory; 0: nearly all that the machine has left. */
    std::uint64_t most_bytes = 0;
    /** Of its command line, before the command: how much it says. */
    std::vector<std::string> first_arguments;
    /** From the wish that it stop to its end by force: a plugin may not return. */
    std::chrono::milliseconds patience{3000};
    /** Asked after the wish that it stop: whether it is to end at once. May be empty. */
    std::function<bool()> is_urgent;
};

/**
 * Runs `/proc/self/exe convert ... --answer` and passes progress and cancellation on. A plugin that crashes, does not return or
 * takes all memory ends that process and not this one: then an Error names file, plugin and signal. Like convert(), it leaves
 * nothing behind unless all was done. It must be waited for by the thread that called it.
 */
ConvertReport convert_separately(const ConvertRequest& request, const TaskControl& control, const ConvertProcess& process);

/** The other side: converts, and tells the descriptor how it goes and what came of it. Throws nothing. */
void answer_conversion(const ConvertRequest& request, TaskControl& control, int descriptor);

/** First letter of the line by which the process says that it crashes: plugin and function, with 0x1f between them. */
inline constexpr char crash_mark = 'C';

} // namespace elvis
