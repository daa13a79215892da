/**
 * @file say_remarks.hpp
 * What people should know of pictures, in the log.
 */
#pragma once

#include <core/session/frame_remarks.hpp>

#include <spdlog/spdlog.h>

#include <vector>

namespace elvis::commands {

inline void say(const std::vector<FrameRemark>& remarks) {
    for (const FrameRemark& remark : remarks) {
        spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
    }
}

} // namespace elvis::commands
