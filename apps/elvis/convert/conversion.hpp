/**
 * @file conversion.hpp
 * A whole conversion, from file names to the native volume: by the library, here or in a process of its own.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace elvis::commands {

/** See elvis_conversion. */
struct Conversion {
    /** Geometry first, then field files. */
    std::vector<std::string> inputs;
    std::string output;
    /** Id of the conversion plugin; empty: the one surest of the first input. */
    std::string plugin{};
    /** JSON; may be empty. */
    std::string options{};
    std::vector<std::string> fields{};
    /** "cg", "dg", or empty for what the source says. */
    std::string continuity{};
    int order = -1;
};

/** In this process. Returns the report, JSON. Throws cancelled, or error. */
std::string convert_here(const Conversion& conversion, const TaskControl& control);

/** How a process that converts is treated. */
struct ConvertProcess {
    /** Descriptor to which it writes warnings, and plugins whatever they print. */
    int output = 2;
    /** It is ended when it takes more main memory; 0: nearly all that the machine has left. */
    std::uint64_t most_bytes = 0;
    /** Of its command line, before the command: how much it says. */
    std::vector<std::string> first_arguments{};
    /** From the wish that it stop to its end by force: a plugin may not return. */
    std::chrono::milliseconds patience{3000};
    /** Asked after the wish that it stop: whether it is to end at once. May be empty. */
    std::function<bool()> is_urgent{};
};

/**
 * Runs `/proc/self/exe convert ... --answer` and passes progress and cancellation on. A plugin that crashes, does not return or
 * takes all memory ends that process and not this one: then an Error names file, plugin and signal. Nothing is left behind
 * unless all was done. It must be waited for by the thread that called it. Returns the report, JSON. Throws Cancelled, or
 * Error.
 */
std::string convert_separately(const Conversion& conversion, const TaskControl& control, const ConvertProcess& process);

/** The other side: converts, and tells the descriptor how it goes and what came of it. Throws nothing. */
void answer_conversion(const Conversion& conversion, TaskControl& control, int descriptor);

/** First letter of the line by which the process says that it crashes: plugin and function, with 0x1f between them. */
inline constexpr char crash_mark = 'C';

} // namespace elvis::commands
