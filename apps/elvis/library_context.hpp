/**
 * @file library_context.hpp
 * The library as commands use it: through its public interface alone.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <string>

namespace elvis::commands {

/** With the program's plugins, cache and log. `device`: as for --device; empty: what the environment says, else the best. */
context library_context(const std::string& device = {}, elvis_context_flags flags = 0);

} // namespace elvis::commands
