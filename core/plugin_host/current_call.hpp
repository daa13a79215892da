/**
 * @file current_call.hpp
 * The calls of plugin functions that are under way, for those who report crashes and hangs.
 */
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::current_call {

/** This thread enters a plugin's function. `plugin` and `function` must live until end(). */
void begin(const char* plugin, const char* function);
/** The function that this thread is in reported progress or wrote to the log. */
void give_sign();
void end();

/** Of this thread, or null. Safe in a signal handler. */
const char* plugin();
const char* function();

struct SilentCall {
    std::string plugin;
    std::string function;
    /** Since it began or gave a sign. */
    std::chrono::milliseconds silence{};
    /** Which call it is, among all of the process. */
    std::uint64_t number = 0;
};

/** Calls on any thread that gave no sign for at least this long. Safe on any thread. */
std::vector<SilentCall> silent_for(std::chrono::milliseconds silence);

} // namespace elvis::current_call
