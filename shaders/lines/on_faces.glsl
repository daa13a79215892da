// Faces of elements, for lines/subpixel_search.glsl. The face that the pixel shows is asked first, then all others of which patches reach
// into a box around the pixel's part of the tangent plane. Each subpixel lies on the tangent plane of the face near it
// (lines/own_face.glsl), so that what bends vanishes with the subpixel's size.
//
// That no line is met is certain if no subpixel is left open, and the face that the pixel shows fills it, or the surface is smooth around
// it.

#include "boundary/face_patch.glsl"
#include "element/face_frame.glsl"
#include "lines/surface_box.glsl"
#include "lines/own_face.glsl"

#define CORE_MOVES_FIRST 0

struct core_surface {
    core_listed_pixel listed;
    core_box box;
    // Where the pixel's own point lies, and whether that is an element of this class; rays enter the volume there.
    core_place place;
    bool is_shown_class, enters;
    // Seen at so small an angle that what faces the viewer, too, may be another sheet, hidden behind a silhouette.
    bool is_oblique;
};

// Cosine of that angle.
#define CORE_OBLIQUE elvis_real(0.3LF)

core_line_search core_begin_surface(core_listed_pixel listed, out core_surface surface) {
    const core_place place = core_places[listed.pixel];
    surface.listed = listed;
    surface.place = place;
    surface.is_shown_class = core_class_of(place) == core_class;
    surface.is_oblique = -dot(listed.tangent.normal, listed.ray.direction) < CORE_OBLIQUE * length(listed.ray.direction);
    surface.enters = (place.class_and_face & CORE_PLACE_ENTERS) != 0u;
    const core_cut_square corners =
        core_tangent_square(listed.tangent, core_picture_square(listed.column, listed.row, elvis_real(0.5LF)));
    // And what a pixel's part of a smooth surface departs from its plane.
    surface.box = core_box_around(corners, corners.error, 0.1);

    const bool is_filled = (place.class_and_face & CORE_PLACE_FILLED) != 0u;
    const bool is_usable = listed.is_pixel && !listed.around.may_be_hidden;
    // Beside a face that fills the pixel, or on a smooth surface, there is nothing else.
    const bool is_complete = is_usable && (is_filled || (listed.around.is_smooth && corners.all_hit));
    core_line_search search =
        core_begin_listed(listed, core_subdivisions, is_usable && !is_filled && corners.all_hit, is_complete);
    if (surface.is_shown_class) {
        search.item = is_usable ? place.element : CORE_NO_ITEM;
        search.own_face = core_face_of(place);
        search.x = place.x;
        search.y = place.y;
        search.z = place.z;
    }
    return search;
}

bool core_is_shown_face(const core_surface surface, uint element, int face) {
    return surface.is_shown_class && element == surface.place.element && face == core_face_of(surface.place);
}

// Whether a patch may reach into a box; `start`: to first order, the point of its face nearest to the middle of the box.
bool core_patch_reaches(uint index, core_box box, core_face face, out elvis_vec3 start) {
    const vec3 middle = 0.5 * (box.lower + box.upper), half_size = 0.5 * (box.upper - box.lower);
    const vec4 to_u = uintBitsToFloat(elvis_fetch4_core_patches(index, 0u));
    const vec4 to_v = uintBitsToFloat(elvis_fetch4_core_patches(index, 1u));
    const vec4 to_s = uintBitsToFloat(elvis_fetch4_core_patches(index, 2u));
    const vec4 bounds = uintBitsToFloat(elvis_fetch4_core_patches(index, 3u));
    const core_square square = core_square_of(elvis_fetch4_core_patches(index, 4u).w);
    const float a = dot(to_u.xyz, middle) + to_u.w, b = dot(to_v.xyz, middle) + to_v.w, s = dot(to_s.xyz, middle) + to_s.w;
    const float u = square.a + square.size * clamp(a, -1.0, 1.0), v = square.b + square.size * clamp(b, -1.0, 1.0);
    start = face.corner + elvis_real(0.5 * (u + 1.0)) * face.a + elvis_real(0.5 * (v + 1.0)) * face.b;
    const bool is_beside = abs(a) > 1.0 + bounds.x + dot(abs(to_u.xyz), half_size) ||
                           abs(b) > 1.0 + bounds.x + dot(abs(to_v.xyz), half_size);
    return !is_beside && abs(s) <= bounds.y + dot(abs(to_s.xyz), half_size);
}

void core_select_item(const core_surface surface, uint patch_index, inout core_line_search search) {
    const uint face = elvis_fetch4_core_patches(patch_index, 4u).z;
    const uvec4 of_face = elvis_fetch4_core_faces(face, 0u);
    search.own_face = int(of_face.y);
    elvis_vec3 start;
    const bool reaches = core_patch_reaches(patch_index, surface.box, core_face_frame(search.own_face), start);
    const bool is_news = !core_is_shown_face(surface, of_face.x, search.own_face) && face != search.last_face;
    search.last_face = reaches && is_news ? face : search.last_face;
    search.item = reaches && is_news ? of_face.x : CORE_NO_ITEM;
    core_begin_element(search, start);
}

core_shown_square core_square_on(const core_surface surface, const core_line_search search, const core_element_image image,
                                 core_picture_square place) {
    core_shown_square square = core_own_square_at(image, max(search.own_face, 0), place);
    // A line is met on faces that face the viewer as the one that the pixel shows; both sides of an element of two dimensions do.
    const bool is_facing = CORE_HAS_TWO_DIMENSIONS || square.enters == surface.enters;
    const bool is_shown = core_is_shown_face(surface, search.item, search.own_face);
    // What is seen at a small angle lines/face_lines_careful.comp decides.
    const bool is_in_view = !surface.is_oblique && (is_shown || surface.listed.around.is_smooth);
    square.is_seen = square.is_seen && is_facing && is_in_view;
    // Another sheet of the surface, farther behind than a smooth one departs from its plane: hidden by this one.
    const core_cut_square corners = square.corners;
    const elvis_vec3 middle = elvis_real(0.25LF) * (corners.corner0 + corners.corner1 + corners.corner2 + corners.corner3);
    const elvis_real height = dot(surface.listed.tangent.normal, middle - surface.listed.tangent.point);
    square.is_hidden = surface.listed.around.is_smooth && !is_shown && !square.approach.is_far &&
                       height < elvis_real(-0.5LF) * elvis_real(surface.box.diagonal);
    return square;
}

elvis_vec3 core_expected_point(const core_surface surface, const core_shown_square square, core_picture_square place, out bool is_met) {
    elvis_real t;
    const elvis_vec3 point = core_tangent_point(square.tangent, place.column, place.row, t);
    is_met = t < CORE_FAR;
    return point;
}
