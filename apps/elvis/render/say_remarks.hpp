/**
 * @file say_remarks.hpp
 * What people should know of pictures, in the log.
 */
#pragma once

#include <elvis/elvis.hpp>
#include <spdlog/spdlog.h>

#include <string>
#include <vector>

namespace elvis::commands {

/** `of`: what stands before each. */
inline void say(const std::vector<picture::remark>& remarks, const std::string& of = {}) {
    for (const picture::remark& remark : remarks) {
        spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}{}", of, remark.text);
    }
}

} // namespace elvis::commands
