// Which of the listed pixels of faces meet contours of the field, and edges of the faces; for the faces of one class
// (lines/line_search.glsl).
//
// What stays open is listed for the next round, or for lines/face_lines_careful.comp. The first round divides no pixel, and most
// need no other.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "lines/listed_pixel.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops.
#define CORE_WORK_LIMIT 1500u

#include "lines/on_faces.glsl"
#include "lines/line_search.glsl"

void main() {
    const core_listed_pixel listed = core_listed_pixel_here();
    core_surface surface;
    core_line_search search = core_begin_surface(listed, surface);
    core_search_lines(surface, search);
    core_answer(listed, search.lines, core_is_unfinished(search));
    core_count_evaluations(search.n_evaluations);
}
