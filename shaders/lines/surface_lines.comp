// Which of the listed pixels meet contours of the field, and boundaries of elements, on faces or a curved surface; for the elements
// of one class.
//
// What stays open is listed for the next round: after a first one that divides no pixel, which most need no more than, rounds that do.
// On quadrics without ends the last ones are those of CORE_BY_QUADRIC_SPANS, on faces those of lines/face_lines_careful.comp.

layout(local_size_x = 32) in;

#include "lines/listed_pixel.glsl"

// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops. Near silhouettes of shapes
// any number would be used up, for which the other pixels of a group wait.
#if CORE_ON_FACES
#define CORE_WORK_LIMIT 1500u
#include "lines/on_faces.glsl"
#else
#define CORE_WORK_LIMIT (core_subdivisions <= CORE_FEW_SUBDIVISIONS ? 150u : 2000u)
#if CORE_BY_QUADRIC_SPANS
#include "lines/on_quadric.glsl"
#else
#include "lines/on_tangent_plane.glsl"
#endif
#endif
#include "lines/subpixel_search.glsl"
#include "lines/line_search.glsl"

void main() {
    const core_listed_pixel listed = core_listed_pixel_here();
    core_surface surface;
    core_line_search search = core_begin_surface(listed, surface);
    core_search_lines(surface, search);
    core_store_or_relist(listed, search);
}
