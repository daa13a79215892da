// A cut plane, for lines/subpixel_search.glsl.

#define CORE_FACES_IN_SURFACE 1

#include "lines/search_state.glsl"
#include "lines/surface_box.glsl"
#include "lines/element_start.glsl"
#include "cut_surface/cut_horizon.glsl"
#include "cut_surface/meets_plane.glsl"

// In place of what lines/surface_box.glsl says.
#undef core_reaches
#define core_reaches(surface, node) (core_overlaps(node, surface.box.lower, surface.box.upper) && core_meets_plane(node))

#define CORE_MOVES_FIRST 1

struct core_surface {
    core_cut_square corners;
    core_box box;
    // Where the plane lies in faces, elements on its far side are hidden by those on the near one; or may be: the pixel's middle shows none.
    bool hides_behind, may_hide_behind;
    // Distance along the axis of view behind which there is no element.
    elvis_real volume_end;
    // None of it is seen in the pixel.
    bool is_absent;
#if CORE_STRONGLY_BENT
    // Number of the element that the pixel's middle shows.
    uint own_number;
#endif
};

bool core_shows_nothing(core_cut_square corners, core_picture_square place, elvis_real volume_end) {
    return !corners.all_hit && (!corners.any_hit || core_is_square_behind_volume(place, volume_end));
}

core_surface core_plane_at(elvis_real column, elvis_real row, bool hides_behind, bool may_hide_behind) {
    const core_picture_square place = core_picture_square(column, row, elvis_real(0.5LF));
    core_surface surface;
    surface.corners = core_cut_corners(place);
    surface.box = core_box(vec3(-3e38), vec3(3e38), 3e38);
    if (surface.corners.all_hit) {
        surface.box = core_box_around(surface.corners, surface.corners.error, 0.0);
    }
    surface.hides_behind = hides_behind;
    surface.may_hide_behind = may_hide_behind;
    surface.volume_end = core_volume_end();
    surface.is_absent = core_shows_nothing(surface.corners, place, surface.volume_end);
#if CORE_STRONGLY_BENT
    surface.own_number = CORE_NO_NUMBER;
#endif
    return surface;
}

void core_select_item(const core_surface surface, uint element, inout core_line_search search) {
    const core_cut_square corners = surface.corners;
    const elvis_vec3 middle = elvis_real(0.25LF) * (corners.corner0 + corners.corner1 + corners.corner2 + corners.corner3);
#if CORE_STRONGLY_BENT
    if (search.asks_own && elvis_fetch4_core_elements(element, 0u).x != surface.own_number) {
        return;
    }
#endif
    core_select_element(element, corners, middle, core_plane_normal.xyz, elvis_real(1), search);
}

core_shown_square core_square_on(const core_surface surface, const core_line_search search, const core_element_image image,
                                 core_picture_square place) {
    const core_cut_square corners = core_cut_corners(place);
    const elvis_vec3 direction = core_cut_ray_at(place.column, place.row).direction;
    core_shown_square square = core_shown_square_at(image, corners, core_plane_normal.xyz, direction, CORE_NO_FACE);
    square.is_absent = core_shows_nothing(corners, place, surface.volume_end);
    square.is_hidden = square.subpixel.is_grazed || (square.subpixel.is_behind && surface.hides_behind);
    square.is_seen = square.is_seen && !(square.subpixel.may_be_behind && surface.hides_behind);
#if CORE_STRONGLY_BENT
    // In the plane of its face an element may be hidden by one on the other side, and fills nothing.
    const bool is_in_front = !square.subpixel.is_behind && !square.subpixel.may_be_behind;
    square.subpixel.is_inside = square.subpixel.is_inside && (is_in_front || !search.asks_own);
#endif
    const bool is_behind = square.subpixel.is_behind || square.subpixel.may_be_behind;
    square.may_hide_contour = surface.may_hide_behind && is_behind;
    square.wanted_sides = !surface.may_hide_behind ? 0u : (is_behind ? CORE_BEHIND : 0u) | (square.subpixel.is_before ? CORE_BEFORE : 0u);
    return square;
}

elvis_vec3 core_expected_point(const core_surface surface, const core_shown_square square, core_picture_square place, out bool is_met) {
    const core_cut_point point = core_cut_pixel(core_cut_begin(place.column), place.row);
    is_met = point.is_hit;
    return point.position;
}
