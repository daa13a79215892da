// A curved surface that is no face, for lines/subpixel_search.glsl: its tangent plane at the pixel's own point. What the surface departs
// from the plane is an error of the corners of squares: half the bending times the square of the distance, along the oblique ray.
//
// Where the neighbouring pixels see points near that plane, the surface is smooth. Where one of them sees a point in front of it,
// something may hide a part of the pixel, and nothing is certain. Elsewhere, at edges and silhouettes, other parts of the surface
// may show in the pixel: a line that is met there is met. That none is met rests on a square three times the pixel's size.

#include "lines/surface_box.glsl"
#include "lines/element_start.glsl"
#if CORE_SHAPE_ROWS > 0
#include "surface/quadric_span.glsl"
#endif

#define CORE_MOVES_FIRST 0
// Levels to which pixels are divided in which the surface is not smooth.
#define CORE_ROUGH_LEVEL 2u
// Cosine of the angle below which a pixel shows so much of the surface that nothing is learned.
#define CORE_EDGE_ON elvis_real(0.06LF)

struct core_surface {
    core_listed_pixel listed;
    // Of the square that is asked about first, and by how much the surface departs from the plane in it.
    core_cut_square corners;
    elvis_real departure;
    core_box box;
};

elvis_real core_first_half_size(bool is_smooth) { return is_smooth ? elvis_real(0.5LF) : elvis_real(1.5LF); }

core_line_search core_begin_surface(core_listed_pixel listed, out core_surface surface) {
    const bool is_smooth = listed.around.is_smooth;
    surface.listed = listed;
    const elvis_real half_size = core_first_half_size(is_smooth);
    surface.corners = core_tangent_square(listed.tangent, core_picture_square(listed.column, listed.row, half_size));
    const core_departure bent = core_departure_in(surface.corners, listed.tangent, listed.ray, half_size,
                                                  CORE_REAL(core_bending, listed.pixel), listed.around.turning, false);
    surface.departure = bent.distance;
    surface.box = core_box_around(surface.corners, surface.corners.error + bent.distance, 0.0);

    // Where corners miss the plane, or nearly so, the surface is seen edge on.
    const bool is_edge_on = -dot(listed.tangent.normal, listed.ray.direction) < CORE_EDGE_ON * length(listed.ray.direction);
    // Where the surface is not smooth, the search can only find lines, never exclude them. It runs in the first rounds only.
    const bool is_searched = is_smooth || core_subdivisions <= CORE_FEW_SUBDIVISIONS;
#if CORE_SHAPE_ROWS > 0
    // lines/on_quadric.glsl decides more.
    const bool is_left = core_subdivisions > 0u && core_is_quadric_front(listed.column, listed.row, listed.tangent.point);
#else
    const bool is_left = false;
#endif
    const bool is_bounded = bent.distance < CORE_FAR;
    const bool is_known =
        surface.corners.all_hit && is_bounded && !listed.around.may_be_hidden && !is_edge_on && is_searched && !is_left;
    const uint most_level = is_smooth ? core_subdivisions : min(core_subdivisions, CORE_ROUGH_LEVEL);
    core_line_search search = core_begin_listed(listed, most_level, is_known, is_known);
    search.lines.is_estimated = !is_smooth || bent.is_estimated;
    return search;
}

void core_select_item(const core_surface surface, uint element, inout core_line_search search) {
    // What the surface departs from its tangent plane is less than the pixel's size where it is smooth.
    const elvis_real room = surface.listed.around.is_smooth ? elvis_real(2) : elvis_real(0);
    core_cut_square corners = surface.corners;
    corners.error += surface.departure;
    core_select_element(element, corners, surface.listed.tangent.point, surface.listed.tangent.normal, room, search);
}

core_shown_square core_square_on(const core_surface surface, const core_line_search search, const core_element_image image,
                                 core_picture_square place) {
    const bool is_first = search.level == 0u, is_smooth = surface.listed.around.is_smooth;
    const core_tangent tangent = surface.listed.tangent;
    core_picture_square asked = place;
    asked.half_size = is_first ? core_first_half_size(is_smooth) : place.half_size;
    core_cut_square corners = core_tangent_square(tangent, asked);
    // As those around them were.
    corners.all_hit = true;
    corners.error += surface.departure;
    core_shown_square square =
        core_shown_square_at(image, corners, tangent.normal, surface.listed.ray.direction, CORE_NO_FACE);
    square.is_whole_pixel = is_first && is_smooth;
    square.is_oversized = is_first && !is_smooth;
    square.is_seen = !square.is_oversized;
    return square;
}

elvis_vec3 core_expected_point(const core_surface surface, const core_shown_square square, core_picture_square place, out bool is_met) {
    elvis_real t;
    is_met = true;
    return core_tangent_point(surface.listed.tangent, place.column, place.row, t);
}
