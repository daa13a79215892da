/**
 * @file fold.hpp
 * Pixels of a picture from what parts show there.
 */
#pragma once

#include <core/parts/part_picture.hpp>
#include <core/parts/tile_shares.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/precision.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Light of a part in a block of pixels, which are counted in the block. */
struct PartRuns {
    std::uint32_t part = 0;
    std::vector<LightRun> runs;
};

/** Not again behind where they meet it. */
bool meets_rays_once(const Surface& surface);
/** Of surfaces that lie in no element: all have it at one depth, and lines that end in the pixel are seen by parts whose
 * elements are beside it. */
bool is_better_outside(const PartPixel& one, const PartPixel& than);

/** Background alone. */
Frame empty_block(const FrameRequest& request, const PixelBlock& block, Precision precision);

/**
 * Pixels of one surface, which is the only one of the request. Of each the nearest that a part shows of its own elements: the
 * part has drawn them together with those around, so that it is the part which owns the element that the whole picture shows.
 * Where parts do not agree on which one that is, rounding decides, and the pixel is flagged as undecided (256). Doubt of any
 * part stays. With lines, pixels near which the part does not see what the picture shows are flagged as undecided (2, 512).
 * `block`: of which all is known; `kept`: of which pixels are given. `parts`: of each at most one, in their order. `diagonal`:
 * of the whole volume's bounds.
 */
Frame folded(const FrameRequest& request, const PixelBlock& block, const PixelBlock& kept, std::span<const PartPixels> parts,
             double diagonal, Precision precision);

/** What of a part's flags holds for the pixel, whatever is nearest there. */
std::uint32_t doubts_of(const PartPixel& pixel);
/** Of the diagonal: much more than the depth of one surface differs by between two parts' pictures. */
inline constexpr double same_depth = 1e-4;

/** Adds pixels of a folded surface, as shaders/picture/merge.comp does. */
void add_surface(const Frame& surface, Frame& picture);
/** Of one pixel: its flags with those of a surface that it shows, if it is the nearest, or hides. */
std::uint32_t merged_flags(std::uint32_t picture, std::uint32_t surface, bool is_drawn, bool is_nearest);
/** Of a surface with these flags that is seen through a transparent one: to be added to the pixel's. */
std::uint32_t doubt_behind(std::uint32_t flags);
/** When all are added: flags as callers know them. */
void finish_surfaces(Frame& picture);

/** What light goes by. */
struct LightRule {
    double tolerance = 0;
    /** What each channel is off besides: the most of all parts. */
    double color_error = 0;
    /** Of the whole volume's bounds. */
    double diagonal = 0;
};

/**
 * Puts light of the volume in front of what the block shows: along each ray the runs of all parts, in the order in which they
 * begin. What each is off adds up; where that is more than the tolerance the pixel is flagged (128), and as undecided (256)
 * where runs overlap by more than rounding. `stops`: surfaces that can be seen through, as such runs, each behind the light
 * that has passed as many stops. Returns how many pixels have light.
 */
std::uint64_t add_light(const LightRule& rule, std::span<const PartRuns> parts, std::span<const LightRun> stops,
                        Frame& picture);

/** Frames without pixels: all else that is known of a picture. */
Frame empty_facts(const FrameRequest& request);
/** Of one surface, from those of the parts. */
Frame folded_facts(const FrameRequest& request, std::span<const Frame> parts);
/** Adds those of the surface of this index. */
void add_surface_facts(const Frame& surface, std::size_t index, Frame& picture);
/** Counts of work and times alone. */
void add_work(const Frame& from, Frame& to);

} // namespace elvis
