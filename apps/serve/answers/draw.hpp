/**
 * @file draw.hpp
 * The volume's answers to a session: pictures of a scene in stages, values at a place, which pixels are undecided.
 */
#pragma once

#include "images.hpp"

#include <apps/elvis/view/model/frame_schedule.hpp>
#include <apps/serve/served.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace elvis::serve {

using view::FrameSchedule;
using view::FrameStage;

/** A picture as bytes, and what is told about it. */
struct Encoded {
    nlohmann::json facts;
    std::string bytes;
    double milliseconds = 0;
    bool is_refinable = true;
};

/** How a picture goes over the line. */
struct Line {
    /** Pixels across and down that become one, for clients who are slow. */
    std::uint32_t shrink = 1;
    int quality = 80;
};

/** A JPEG of the step. */
Encoded draw_for_screen(const Served& served, const Scene& scene, const FrameSchedule::Step& step, const Line& line,
                        const task& watch);
/** The bytes of `elvis render`. */
Encoded draw_exactly(const Served& served, const Scene& scene, const task& watch, PictureFormat format = PictureFormat::png);
/** One bit a pixel, rows from the top without gaps, the highest bit first: whether a flag says that the pixel may be wrong. */
Encoded draw_undecided(const Served& served, const Scene& scene, const task& watch);

/** JSON of elvis_data_pick. */
nlohmann::json pick_at(const Served& served, const Scene& scene, double column, double row, const task& watch);

} // namespace elvis::serve
