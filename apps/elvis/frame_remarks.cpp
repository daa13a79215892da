#include "frame_remarks.hpp"

namespace elvis::commands {

std::vector<FrameRemark> remarks_on(const FrameCounts& counts) {
    std::vector<FrameRemark> remarks;
    const auto add = [&remarks](bool is_warning, std::uint64_t count, const char* before, const char* after) {
        if (count > 0) {
            remarks.push_back({is_warning, std::string(before) + std::to_string(count) + after});
        }
    };
    if (counts.hit_pixels == 0 && counts.volume_pixels == 0) {
        remarks.push_back({true, "nothing is hit: the picture shows background only"});
    }
    add(true, counts.newton_failures, "",
        " inversions of the mapping failed; their pixels carry flag 8, of isosurfaces flag 64 if that leaves them open");
    add(true, counts.half_drawn_elements, "of ",
        " cut elements only the flat faces are drawn, not where they are cut; the boundary as a whole shows that, too");
    add(true, counts.nan_pixels, "", " pixels show values that are not finite");
    add(true, counts.work_limit_pixels, "", " pixels reached the work limit and may be wrong; they carry flag 1024");
    add(false, counts.inexact_volume_pixels, "in ",
        " pixels volume rendering did not reach its tolerance; they carry flag 128");
    add(false, counts.undecided_pixels, "", " pixels are undecided within rounding");
    add(false, counts.undecided_isosurface_pixels, "for ",
        " pixels it is undecided whether they meet an isosurface, or one before that shown; they carry flag 64");
    add(false, counts.undecided_contour_pixels, "for ",
        " pixels it is undecided whether they meet a contour; they carry flag 2");
    add(false, counts.undecided_mesh_line_pixels, "for ",
        " pixels it is undecided whether they meet a mesh line; they carry flag 512");
    return remarks;
}

} // namespace elvis::commands
