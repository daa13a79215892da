#include <core/base/log.hpp>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>
#include <string_view>

namespace elvis {

void set_up_log(Verbosity verbosity) {
    if (const char* wanted = std::getenv("ELVIS_LOG")) {
        verbosity = std::string_view(wanted) == "verbose" ? Verbosity::verbose
                    : std::string_view(wanted) == "quiet" ? Verbosity::quiet
                                                          : verbosity;
    }
    auto logger = std::make_shared<spdlog::logger>("elvis", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    logger->set_pattern("elvis: %^%l%$: %v");
    logger->set_level(verbosity == Verbosity::verbose ? spdlog::level::debug
                      : verbosity == Verbosity::quiet ? spdlog::level::err
                                                      : spdlog::level::warn);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace elvis
