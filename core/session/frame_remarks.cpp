#include <core/session/frame_remarks.hpp>

#include <core/base/counted.hpp>

namespace elvis {

std::vector<FrameRemark> remarks_on(const FrameCounts& counts) {
    std::vector<FrameRemark> remarks;
    const auto add = [&remarks](bool is_warning, std::uint64_t count, const char* before, const char* what, const char* after) {
        if (count > 0) {
            remarks.push_back({is_warning, before + counted(count, what) + after});
        }
    };
    if (counts.hit_pixels == 0 && counts.volume_pixels == 0) {
        remarks.push_back({true, "nothing is hit: the picture shows background only"});
    }
    add(true, counts.newton_failures, "", "inversion",
        " of the mapping failed; such pixels carry flag 8, of isosurfaces flag 64 if that leaves them open");
    add(true, counts.half_drawn_elements, "of ", "cut element",
        " only the flat faces are drawn, not where they are cut; the boundary as a whole shows that, too");
    add(true, counts.overlapping_elements, "", "element",
        " overlap others, or are overlapped: there the picture shows one of them");
    add(true, counts.overlap_pixels, "in ", "pixel",
        " of cut surfaces elements overlap, and which one is shown means nothing; they carry flag 8192");
    add(true, counts.nan_pixels, "in ", "pixel", " values are shown that are not finite");
    add(true, counts.work_limit_pixels, "in ", "pixel",
        " the work limit was reached, and they may be wrong; they carry flag 1024");
    add(false, counts.inexact_volume_pixels, "in ", "pixel",
        " volume rendering did not reach its tolerance; they carry flag 128");
    add(false, counts.undecided_pixels, "in ", "pixel", " it is undecided within rounding what is seen");
    add(false, counts.undecided_isosurface_pixels, "for ", "pixel",
        " it is undecided whether they meet an isosurface, or one before that shown; they carry flag 64");
    add(false, counts.undecided_contour_pixels, "for ", "pixel",
        " it is undecided whether they meet a contour; they carry flag 2");
    add(false, counts.undecided_mesh_line_pixels, "for ", "pixel",
        " it is undecided whether they meet a mesh line; they carry flag 512");
    return remarks;
}

} // namespace elvis
