/**
 * @file picture.hpp
 * Pictures as the window shows them.
 */
#pragma once

#include <core/annotation/plan.hpp>
#include <core/render/frame.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::view {

struct Picture {
    std::uint32_t width = 0, height = 0;
    /** Eight bits a channel, rounded as in PNG files; over grey where the background is not opaque. */
    std::vector<std::uint8_t> rgba;
    FrameCounts counts;
    Camera camera;
    /** Without what only the first picture of its kind takes: upload and compilation. */
    double milliseconds = 0;
    /** FrameStage::exact differs from FrameStage::full. */
    bool is_refinable = false;
    /** What finds no room on it, and the like. */
    std::vector<std::string> remarks;
};

/**
 * Of `width` and `height`, with annotation of that size: of a smaller frame each pixel is a copy of the nearest. Camera, time
 * and whether it can be refined are left open.
 */
Picture picture_of(const Frame& frame, const AnnotationPlan& annotation, std::uint32_t width, std::uint32_t height);

} // namespace elvis::view
