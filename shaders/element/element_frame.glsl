// J^-1 at a point of an element by rows, and the rounding error of positions in reference coordinates.

#ifndef CORE_ELEMENT_FRAME
#define CORE_ELEMENT_FRAME

#include "arithmetic/finite.glsl"
#include "arithmetic/precision.glsl"

elvis_real core_max_norm(elvis_vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

struct core_frame {
    elvis_vec3 row0, row1, row2;
    // Of positions, and what that makes of reference coordinates.
    elvis_vec3 position_error, xi_error;
    // Of the Jacobian's columns, and their product over the determinant: what rounding of its inverse grows by.
    elvis_vec3 lengths;
    elvis_real conditioning;
    bool is_sound;
};

// `position_error`: of the points that are compared with this one, beyond the rounding of the mapping.
core_frame core_frame_at(elvis_vec3 position, elvis_mat3 jacobian, elvis_real position_error) {
    const elvis_vec3 cofactors0 = cross(jacobian[1], jacobian[2]);
    const elvis_vec3 cofactors1 = cross(jacobian[2], jacobian[0]);
    const elvis_vec3 cofactors2 = cross(jacobian[0], jacobian[1]);
    const elvis_real inverse_determinant = elvis_real(1) / dot(jacobian[0], cofactors0);
    core_frame frame;
    frame.row0 = inverse_determinant * cofactors0;
    frame.row1 = inverse_determinant * cofactors1;
    frame.row2 = inverse_determinant * cofactors2;
    // A position is rounded relative to the element's extent in that direction, which is about the Jacobian's row sum (and to
    // its own size, where positions are not relative to the element); J^-1 takes that to xi. 4: rounding in the sums over modes.
    const elvis_vec3 extent = abs(jacobian[0]) + abs(jacobian[1]) + abs(jacobian[2]) + abs(position);
    const elvis_vec3 error = elvis_real(4) * CORE_ROUNDOFF * extent + position_error;
    frame.position_error = error;
    frame.xi_error = elvis_vec3(dot(abs(frame.row0), error), dot(abs(frame.row1), error), dot(abs(frame.row2), error));
    frame.lengths = elvis_vec3(length(jacobian[0]), length(jacobian[1]), length(jacobian[2]));
    frame.conditioning = frame.lengths.x * frame.lengths.y * frame.lengths.z * abs(inverse_determinant);
    frame.is_sound = core_is_finite(inverse_determinant);
    return frame;
}

// The gradient in the world that `slope` is in reference coordinates.
elvis_vec3 core_to_world(core_frame frame, elvis_vec3 slope) {
    return slope.x * frame.row0 + slope.y * frame.row1 + slope.z * frame.row2;
}

elvis_vec3 core_to_xi(core_frame frame, elvis_vec3 x) {
    return elvis_vec3(dot(frame.row0, x), dot(frame.row1, x), dot(frame.row2, x));
}

#endif
