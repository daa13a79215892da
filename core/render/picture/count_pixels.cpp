#include <core/render/picture/count_pixels.hpp>
#include <core/render/picture/flags_pass.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace elvis {

void count_pixels(Frame& frame) {
    std::array<std::uint32_t, 17> found{}; // As FlagsPass counts them: by bit, then those that show a surface.
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        for (std::uint32_t left = frame.flags[pixel]; left != 0; left &= left - 1) {
            ++found[static_cast<std::size_t>(std::countr_zero(left))];
        }
        found.back() += frame.element[pixel] >= 0 ? 1 : 0;
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
