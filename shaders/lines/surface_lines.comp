// Which of the listed pixels of a shape's or isosurface's layer meet contours of the field and boundaries of elements; for the elements
// of one class (lines/line_search.glsl).
//
// What stays open is listed for the next round: after a first one without halving, which most pixels need no more than, rounds with
// it. On quadrics without ends the last rounds are those of CORE_BY_QUADRIC_SPANS.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "lines/listed_pixel.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops. Near silhouettes any number
// would be used up, for which the other pixels of a group wait.
#define CORE_WORK_LIMIT (core_subdivisions <= CORE_FEW_SUBDIVISIONS ? 150u : 2000u)

#if CORE_BY_QUADRIC_SPANS
#include "lines/on_quadric.glsl"
#else
#include "lines/on_tangent_plane.glsl"
#endif
#include "lines/line_search.glsl"

void main() {
    const core_listed_pixel listed = core_listed_pixel_here();
    core_surface surface;
    core_line_search search = core_begin_surface(listed, surface);
    core_search_lines(surface, search);
    core_answer(listed, search.lines, core_is_unfinished(search));
    core_count_evaluations(search.n_evaluations);
}
