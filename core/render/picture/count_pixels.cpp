#include <core/render/picture/count_pixels.hpp>
#include <core/render/picture/flags_pass.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace elvis {

namespace {

/** As FlagsPass counts them: by bit, then those that show a surface. */
using Found = std::array<std::uint32_t, 17>;

void count_bits(std::uint32_t flags, Found& found) {
    for (std::uint32_t left = flags; left != 0; left &= left - 1) {
        ++found[static_cast<std::size_t>(std::countr_zero(left))];
    }
}

} // namespace

void add_flags(Frame& frame, std::size_t pixel, std::uint32_t flags) {
    const std::uint32_t added = flags & ~frame.flags[pixel];
    if (added == 0) {
        return;
    }
    Found found{};
    count_bits(added, found);
    FlagsPass::add(found, frame.counts);
    frame.flags[pixel] |= added;
}

void count_pixels(Frame& frame) {
    Found found{};
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        count_bits(frame.flags[pixel], found);
        // Surfaces that lie in no element have a depth.
        found.back() += frame.element[pixel] >= 0 || !std::isnan(frame.depth[pixel]) ? 1 : 0;
    }
    FrameCounts& counts = frame.counts;
    for (std::uint64_t* const of_pixels :
         {&counts.hit_pixels, &counts.undecided_pixels, &counts.overlap_pixels, &counts.nan_pixels, &counts.work_limit_pixels,
          &counts.estimated_pixels, &counts.isosurface_pixels, &counts.undecided_isosurface_pixels,
          &counts.inexact_volume_pixels, &counts.contour_pixels, &counts.undecided_contour_pixels, &counts.mesh_line_pixels,
          &counts.undecided_mesh_line_pixels}) {
        *of_pixels = 0;
    }
    counts.pixels = frame.flags.size();
    FlagsPass::add(found, counts);
}

} // namespace elvis
