/**
 * @file log.hpp
 * Log lines, which go to the host (host.hpp). Texts and their arguments as in {fmt}.
 */
#pragma once

#include <core/base/host.hpp>

#include <fmt/format.h>

#include <utility>

namespace elvis {

template <class... Arguments> void log_line(LogLevel level, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    if (host().log) {
        host().log(level, fmt::format(text, std::forward<Arguments>(arguments)...));
    }
}

template <class... Arguments> void log_debug(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    log_line(LogLevel::debug, text, std::forward<Arguments>(arguments)...);
}

template <class... Arguments> void log_warning(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    log_line(LogLevel::warning, text, std::forward<Arguments>(arguments)...);
}

} // namespace elvis
