/**
 * @file screen_picture.hpp
 * Pictures as a window shows them at once, also while things move.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/scene.hpp>
#include <core/session/frame_remarks.hpp>
#include <core/session/still_picture.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

struct ScreenOptions {
    /** Volume rendering to a hundredth of a channel, and lines that are looked for in few subpixels (FrameStage::full). */
    bool is_coarse = false;
    /** Without contours and mesh lines. Of coarse pictures only, as is the next. */
    bool has_no_lines = false;
    /** So many pixels across and down in one. */
    std::uint32_t divisor = 1;
};

struct ScreenPicture {
    std::uint32_t width = 0, height = 0;
    /** Eight bits a channel, rounded as in PNG files; over grey where the background is not opaque. */
    std::vector<std::uint8_t> rgba;
    /** What was drawn; without colours. */
    Frame frame;
    std::vector<FrameRemark> remarks;
    /** Without what only the first picture of its kind takes: upload and compilation. */
    double milliseconds = 0;
    /** A coarse picture of the scene with divisor 1 differs from one that is not coarse. */
    bool is_refinable = false;
};

/**
 * The picture has the scene's size, as has its annotation: of fewer pixels each is copied. Several samples a pixel are drawn if
 * it is not coarse. Throws Error, or Cancelled.
 */
ScreenPicture draw_for_screen(const Scene& scene, const RuntimeVolume& volume, Renderer& renderer, const ScreenOptions& options,
                              const TaskControl* control = nullptr);

/** The scene with so many pixels fewer across and down, and lines only if they are wanted. */
Scene coarser(const Scene& scene, const ScreenOptions& options);
/** A still picture as screens show it, in that size: of fewer pixels each is copied. */
ScreenPicture shown_on_screen(StillPicture still, const std::array<std::uint32_t, 2>& size);

} // namespace elvis
