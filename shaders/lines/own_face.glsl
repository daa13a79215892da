// Subpixels of a surface that is a face of the element itself, or the element, if it has two dimensions.
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

#include "lines/subpixel.glsl"
#include "cut_surface/tangent_square.glsl"

elvis_vec4 core_own_constraint(int own_face) {
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    return elvis_vec4(0, 0, 1, 0);
#else
    return core_face_constraint(own_face);
#endif
}

struct core_own_subpixel {
    core_subpixel subpixel;
    core_cut_square square;
    core_tangent tangent;
    core_frame frame;
    // Middle of the subpixel, as core_subpixel.middle counts from xi; from the image of xi, relative to the reference point.
    elvis_vec3 origin;
    // The ray enters the element through the face.
    bool enters;
};

// `image`: of xi, relative to elvis_origin; `shift`: from there to the reference point. The square has its middle at (column, row).
core_own_subpixel core_own_subpixel_at(elvis_vec3 xi, elvis_vec3 image, elvis_mat3 jacobian, elvis_vec3 shift, int own_face,
                               elvis_real curvature, elvis_real column, elvis_real row, elvis_real half_size) {
    const elvis_real shift_error = elvis_real(2) * CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
    const core_cut_column along = core_cut_begin(column);
    const elvis_real down = row - along.row0;
    const elvis_vec3 direction = (along.direction + down * along.direction_row).xyz;

    core_own_subpixel own;
    own.origin = shift - image;
    core_frame frame = core_frame_at(image, jacobian, shift_error);
    const elvis_vec4 constraint = core_own_constraint(own_face);
    const elvis_vec3 covector = constraint.x * frame.row0 + constraint.y * frame.row1 + constraint.z * frame.row2;
    const elvis_real here = dot(constraint.xyz, xi) + constraint.w;
    const elvis_real square_length = dot(covector, covector), slope = dot(covector, direction);
    own.tangent.point = -own.origin - (here / square_length) * covector;
    own.tangent.normal = (slope > elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / sqrt(square_length) * covector;
    own.enters = slope < elvis_real(0);
    own.square = core_tangent_square(own.tangent, column, row, half_size);

    // Over all rays of the square.
    const elvis_vec3 ray = core_to_xi(frame, direction);
    const elvis_vec3 next = core_to_xi(frame, core_direction_column.xyz), below = core_to_xi(frame, core_direction_row.xyz);
    const elvis_vec3 most = abs(ray) + half_size * (abs(next) + abs(below));
    const elvis_real least = abs(dot(constraint.xyz, ray)) -
                             half_size * (abs(dot(constraint.xyz, next)) + abs(dot(constraint.xyz, below)));
    const elvis_real oblique = elvis_real(1) + core_model_norm1(constraint.xyz) * max(max(most.x, most.y), most.z) /
                                                   max(least, elvis_real(1e-30LF));
    frame = core_frame_at(image, jacobian, own.square.error + shift_error);
    frame.xi_error = oblique * (frame.xi_error + elvis_real(8) * CORE_ROUNDOFF);
    own.frame = frame;
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    const int left_out = CORE_NO_FACE;
#else
    const int left_out = own_face;
#endif
    own.subpixel = core_subpixel_at(xi, frame, own.origin + own.square.corner0, own.origin + own.square.corner1,
                            own.origin + own.square.corner2, own.origin + own.square.corner3, oblique * curvature,
                            own.tangent.normal, direction, left_out);
    const bool is_sound = own.square.all_hit && least > elvis_real(0);
    own.square.all_hit = is_sound;
    return own;
}

#endif
