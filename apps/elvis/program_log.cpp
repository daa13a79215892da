#include "program_log.hpp"

#include <core/base/host.hpp>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace elvis {

namespace {

spdlog::level::level_enum level_of(LogLevel level) {
    switch (level) {
    case LogLevel::debug:
        return spdlog::level::debug;
    case LogLevel::info:
        return spdlog::level::info;
    case LogLevel::warning:
        return spdlog::level::warn;
    case LogLevel::error:
        break;
    }
    return spdlog::level::err;
}

} // namespace

void set_up_log(Verbosity verbosity) {
    if (const auto wanted = environment_variable("ELVIS_LOG")) {
        verbosity = *wanted == "verbose" ? Verbosity::verbose : *wanted == "quiet" ? Verbosity::quiet : verbosity;
    }
    auto logger = std::make_shared<spdlog::logger>("elvis", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    logger->set_pattern("elvis: %^%l%$: %v");
    logger->set_level(verbosity == Verbosity::verbose ? spdlog::level::debug
                      : verbosity == Verbosity::quiet ? spdlog::level::err
                                                      : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
    program_host().log = [](LogLevel level, std::string_view line) { spdlog::log(level_of(level), line); };
}

} // namespace elvis
