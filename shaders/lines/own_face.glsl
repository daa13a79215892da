// Squares on a surface that is a face of the element itself, or the element, if it has two dimensions.
//
// At a point xi of the element, the mapping and the constraint c . xi + w = 0 of the face are linear to first order: the face is a
// plane in the world, on which the corners' rays end. Where they truly end, at x(xi + d), has J d off the linear answer by the
// error of a Newton step (element/prediction.glsl), which the ray then carries back onto the face: in the maximum norm it grows by
// at most
//
//     1 + |c|_1 |J^-1 r| / |c . J^-1 r|
//
// for a ray with direction r, and so does rounding. So nothing is left out as the subpixel shrinks, however the face bends.

#ifndef CORE_OWN_FACE
#define CORE_OWN_FACE

#include "lines/shown_square.glsl"

core_shown_square core_own_square_at(const core_element_image image, int own_face, core_picture_square place) {
    const elvis_real shift_error = elvis_real(2) * image.shift_error;
    const elvis_vec3 direction = core_cut_ray_at(place.column, place.row).direction, origin = image.shift - image.position;
    core_shown_square square;
    square.frame = core_frame_at(image.position, image.jacobian, shift_error);
    const elvis_vec4 constraint = CORE_HAS_TWO_DIMENSIONS ? elvis_vec4(0, 0, 1, 0) : core_face_constraint(own_face);
    const elvis_vec3 covector =
        constraint.x * square.frame.row0 + constraint.y * square.frame.row1 + constraint.z * square.frame.row2;
    const elvis_real here = dot(constraint.xyz, image.xi) + constraint.w;
    const elvis_real square_length = dot(covector, covector), slope = dot(covector, direction);
    square.tangent.point = -origin - (here / square_length) * covector;
    square.tangent.normal = (slope > elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / sqrt(square_length) * covector;
    square.enters = slope < elvis_real(0);
    square.corners = core_tangent_square(square.tangent, place);

    // Over all rays of the square.
    const elvis_vec3 ray = core_to_xi(square.frame, direction);
    const elvis_vec3 next = core_to_xi(square.frame, core_direction_column.xyz);
    const elvis_vec3 below = core_to_xi(square.frame, core_direction_row.xyz);
    const elvis_vec3 most = abs(ray) + place.half_size * (abs(next) + abs(below));
    const elvis_real least = abs(dot(constraint.xyz, ray)) -
                             place.half_size * (abs(dot(constraint.xyz, next)) + abs(dot(constraint.xyz, below)));
    const elvis_real oblique = elvis_real(1) + core_model_norm1(constraint.xyz) * max(max(most.x, most.y), most.z) /
                                                   max(least, elvis_real(1e-30LF));
    square.frame = core_frame_at(image.position, image.jacobian, square.corners.error + shift_error);
    square.frame.xi_error = oblique * (square.frame.xi_error + elvis_real(8) * CORE_ROUNDOFF);
    core_element_image on_face = image;
    on_face.curvature = oblique * image.curvature;
    square.subpixel = core_subpixel_at(on_face, square.frame, square.corners, square.tangent.normal, direction,
                                       CORE_HAS_TWO_DIMENSIONS ? CORE_NO_FACE : own_face);
    square.corners.all_hit = square.corners.all_hit && least > elvis_real(0);
    square.approach = core_approach_to(square.subpixel, image);
    square.is_absent = square.is_hidden = square.may_hide_contour = square.is_whole_pixel = square.is_oversized = false;
    square.is_seen = square.corners.all_hit;
    return square;
}

#endif
