#include "library_context.hpp"

#include <spdlog/spdlog.h>

namespace elvis::commands {

context library_context(const std::string& device, elvis_context_flags flags) {
    auto options = detail::sized<elvis_context_options>();
    options.flags = flags;
    options.device = detail::or_null(device);
    options.log = [](void*, elvis_log_level level, elvis_string line) {
        constexpr spdlog::level::level_enum levels[] = {spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                                                        spdlog::level::err};
        spdlog::log(levels[level], "{}", line);
    };
    return context(options);
}

} // namespace elvis::commands
