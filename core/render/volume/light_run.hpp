/**
 * @file light_run.hpp
 * Light along a part of a ray: what parts of volumes give in place of colours.
 */
#pragma once

#include <cstdint>

namespace elvis {

/** Of one way of a pixel's ray through a volume, in at one face and out at another. As core_light of shaders/volume. */
struct LightRun {
    std::uint32_t pixel = 0;
    /** pixel_flag: of the whole ray, with one of its runs. */
    std::uint16_t flags = 0;
    /** How many of FrameRequest::stops lie before it. */
    std::uint16_t n_stops = 0;
    /** Depths between which it lies. */
    double first = 0, end = 0;
    double red = 0, green = 0, blue = 0;
    double transmittance = 1;
    /** Of each channel; the square of what rounding does. */
    double error = 0, rounding = 0;
};

/** What a channel of such light may be off, rounding included (core_light_error). */
double error_of(const LightRun& light);

/** What follows is seen through what is there. */
void add_behind(LightRun& light, const LightRun& behind);

} // namespace elvis
