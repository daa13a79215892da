// A quadric without ends, for lines/subpixel_search.glsl, silhouettes included. All that the rays of a square can meet of it
// (surface/quadric_span.glsl) shrinks with the square, and needs no plane of the whole pixel. If the pixel shows the front of the
// quadric, then its back counts as hidden, and a line on the front is met.

#include "lines/surface_box.glsl"
#include "lines/element_start.glsl"
#include "surface/quadric_span.glsl"

#define CORE_MOVES_FIRST 0

struct core_surface {
    core_listed_pixel listed;
    // The pixel's span.
    core_cut_square corners;
    core_box box;
    bool is_front;
};

// As a square with two corners at either end.
core_cut_square core_span_corners(core_quadric_span quadric_span) {
    return core_cut_square(quadric_span.from, quadric_span.to, quadric_span.from, quadric_span.to, quadric_span.is_known,
                           quadric_span.is_known, quadric_span.width);
}

core_line_search core_begin_surface(core_listed_pixel listed, out core_surface surface) {
    surface.listed = listed;
    surface.is_front = core_is_quadric_front(listed.column, listed.row, listed.tangent.point);
    surface.corners = core_span_corners(
        core_quadric_span_at(core_picture_square(listed.column, listed.row, elvis_real(0.5LF)), surface.is_front));
    surface.box = core_box_around(surface.corners, surface.corners.error, 0.0);
    return core_begin_listed(listed, core_subdivisions, surface.corners.all_hit, surface.corners.all_hit);
}

void core_select_item(const core_surface surface, uint element, inout core_line_search search) {
    const elvis_vec3 middle = elvis_real(0.5LF) * (surface.corners.corner0 + surface.corners.corner1);
    core_select_element(element, surface.corners, middle, surface.listed.tangent.normal, elvis_real(0), search);
}

core_shown_square core_square_on(const core_surface surface, const core_line_search search, const core_element_image image,
                                 core_picture_square place) {
    const core_quadric_span quadric_span = core_quadric_span_at(place, surface.is_front);
    const core_front front = core_quadric_front(place, quadric_span);
    core_cut_square corners = core_span_corners(quadric_span);
    if (front.is_known) {
        corners = front.square;
        corners.error += front.departure;
    }
    corners.all_hit = true;
    // In no face: a span that looks as if it lay in one may cross it.
    core_shown_square square = core_shown_square_at(image, corners, surface.listed.tangent.normal,
                                                    surface.listed.ray.direction, CORE_N_FACES);
    square.is_absent = quadric_span.is_absent;
    square.is_seen = front.is_known;
    square.approach.is_clear = square.approach.is_clear && front.is_known;
    square.is_whole_pixel = search.level == 0u;
    return square;
}

elvis_vec3 core_expected_point(const core_surface surface, const core_shown_square square, core_picture_square place, out bool is_met) {
    const core_quadric_span expected = core_quadric_span_at(place, surface.is_front);
    is_met = true;
    return elvis_real(0.5LF) * (expected.from + expected.to);
}
