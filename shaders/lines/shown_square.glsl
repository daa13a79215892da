// A square of the picture as the surface fills it, and what an element has to do with it.

#ifndef CORE_SHOWN_SQUARE
#define CORE_SHOWN_SQUARE

#include "lines/subpixel.glsl"
#include "picture/tangent_square.glsl"

struct core_shown_square {
    // All of the surface in the square lies between these points, but for their error. If not all of them are known, nothing is.
    core_cut_square corners;
    core_frame frame;
    core_subpixel subpixel;
    core_approach approach;
    // Nothing of the surface is there.
    bool is_absent;
    // What is there of it hides the element, or is hidden with it.
    bool is_hidden;
    // What is met in the square is seen in the pixel; but for contours, which another element may hide.
    bool is_seen, may_hide_contour;
    // The element has a face in the surface, on that side of it: a line is sure where elements on both sides end. Rounding decides whether
    // the surface meets one that has no neighbour there.
    uint wanted_sides;
    // The square is the pixel, and an element that fills it hides everything else.
    bool is_whole_pixel;
    // The square is larger than the pixel.
    bool is_oversized;
    // On an element's own face: the plane through the corners.
    core_tangent tangent;
    // On an element's own face: rays enter the element there.
    bool enters;
};

// `own_face`: as in core_judge_faces.
core_shown_square core_shown_square_at(const core_element_image image, core_cut_square corners, elvis_vec3 normal, elvis_vec3 direction,
                                       int own_face) {
    core_shown_square square;
    square.corners = corners;
    square.frame = core_frame_at(image.position, image.jacobian, corners.error + image.shift_error);
    square.subpixel = core_subpixel_at(image, square.frame, corners, normal, direction, own_face);
    square.approach = core_approach_to(square.subpixel, image);
    square.is_absent = square.is_hidden = square.may_hide_contour = false;
    square.is_whole_pixel = square.is_oversized = square.enters = false;
    square.wanted_sides = 0u;
    square.is_seen = corners.all_hit;
    return square;
}

#endif
