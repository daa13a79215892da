/**
 * @file picture.hpp
 * Pictures as the window shows them.
 */
#pragma once

#include <apps/elvis/view/scene/camera.hpp>

#include <elvis/elvis.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <vector>

namespace elvis::view {

struct Picture {
    std::uint32_t width = 0, height = 0;
    /** Eight bits a channel, rounded as in PNG files; over grey where the background is not opaque. */
    std::vector<std::uint8_t> rgba;
    /** By name, as --stats has them. */
    nlohmann::json counts;
    Camera camera;
    /** Without what only the first picture of its kind takes: upload and compilation. */
    double milliseconds = 0;
    /** FrameStage::exact differs from FrameStage::full. */
    bool is_refinable = false;
    std::vector<elvis::picture::remark> remarks;
};

} // namespace elvis::view
