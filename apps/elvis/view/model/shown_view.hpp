/**
 * @file shown_view.hpp
 * One view of the scene: when it is to be drawn, and what is on the screen of it.
 */
#pragma once

#include "frame_schedule.hpp"
#include "picture.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace elvis::view {

struct ShownView {
    FrameSchedule schedule{};
    /** The scene that the schedule knows of. */
    std::uint64_t scheduled_revision = 0;
    std::chrono::steady_clock::time_point last_change{};

    /** The last picture; its width is 0 if there is none. */
    Picture picture{};
    /** Of that picture, whatever has changed since. */
    FrameStage stage = FrameStage::none;
    /** So many pixels of the screen across and down are one of it. */
    std::uint32_t divisor = 1;
    std::uint64_t shown_revision = 0;
    /** Of a scene that cannot be drawn, and why. */
    std::uint64_t failed_revision = 0;
    std::string error{};

    /** The picture, in whatever stage, is of this scene. */
    bool shows(std::uint64_t revision) const { return stage != FrameStage::none && shown_revision == revision; }
    /** Nothing more is to come of this scene. */
    bool is_done(std::uint64_t revision) const {
        return failed_revision == revision || (stage == FrameStage::exact && shown_revision == revision);
    }
};

} // namespace elvis::view
