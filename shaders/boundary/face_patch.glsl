// Patches of element faces (core/volume/boundary/face_patches.hpp): what is known of a face on a square of its parameters, before anything
// is evaluated there.
//
// A patch is x(a, b) = x0 + a A + b B + r(a, b), -1 <= a, b <= 1 (a + b <= 0 on the diagonal of a triangle). In the coordinates
// (u, v, s) = (mu . (x - x0), mv . (x - x0), n . (x - x0)), with mu, mv dual to A, B and n their unit normal, the linear part is
// (a, b, 0), and |r| is at most (flat, flat, high). A ray that passes (u0, v0) where s = 0, and moves by (wu, wv) while s grows by
// one, meets the patch at
//
//     a = u0 - r_u + wu r_s,   b = v0 - r_v + wv r_s
//
// so it misses the patch if (u0, v0) is outside of [-1, 1] by more than flat + |w| high. With Lipschitz constants (slope_flat,
// slope_high) of r in the maximum norm, r_u - wu r_s has the constant slope_flat + |w| slope_high: below one there is at most one
// crossing. These constants, and those of the derivatives of r (bend_...), hold on the patch enlarged by CORE_PATCH_REACH.

#define CORE_PATCH_REACH 1.2

struct core_patch_meeting {
    // Whether the ray can meet the patch with t between the limits; and whether at most once.
    bool is_met, is_single;
    float a, b;
    // Lipschitz constant of the nonlinear part, and of its derivative (half of it), for this ray.
    float slope, bend;
};

// The patch's square of parameters, from a word of its row: level, column, row, and whether it lies on the diagonal of a triangle.
struct core_square {
    float a, b, size;
    bool is_diagonal;
};

// Bits of the same word that tell of the face: x_u cross x_v points out of the element; the face on its other side is drawn, too.
#define CORE_FACE_HAS_PARTNER (1u << 28)
#define CORE_FACE_IS_OUTWARD (1u << 29)
#define CORE_FACE_IS_TRIANGLE (1u << 30)

core_square core_square_of(uint word) {
    const float size = exp2(-float(word & 15u));
    const float i = float((word >> 4) & 4095u), j = float((word >> 16) & 4095u);
    return core_square((2.0 * i + 1.0) * size - 1.0, (2.0 * j + 1.0) * size - 1.0, size, (word >> 31) != 0u);
}

// By how much a point lies outside the square [-1, 1]^2, or its lower half.
elvis_real core_patch_excess(elvis_real a, elvis_real b, bool is_diagonal) {
    const elvis_real outside = max(abs(a), abs(b)) - elvis_real(1);
    return is_diagonal ? max(outside, a + b) : outside;
}

// origin and direction in the hierarchy's coordinates; far: size of the coordinates that the ray has near the volume.
core_patch_meeting core_meet_patch(uint index, vec3 origin, vec3 direction, float far, float least_t, float most_t) {
    const vec4 to_u = uintBitsToFloat(elvis_fetch4_core_patches(index, 0u));
    const vec4 to_v = uintBitsToFloat(elvis_fetch4_core_patches(index, 1u));
    const vec4 to_s = uintBitsToFloat(elvis_fetch4_core_patches(index, 2u));
    const vec4 bounds = uintBitsToFloat(elvis_fetch4_core_patches(index, 3u));
    const uvec4 more = elvis_fetch4_core_patches(index, 4u);
    const float slope = dot(to_s.xyz, direction);
    // A ray in the patch's plane: it passes any (u, v).
    const float size = abs(direction.x) + abs(direction.y) + abs(direction.z);
    const bool is_parallel = abs(slope) <= 1e-6 * size;
    const float inverse = is_parallel ? 0.0 : 1.0 / slope;
    const float wu = inverse * dot(to_u.xyz, direction), wv = inverse * dot(to_v.xyz, direction);
    const float t = -inverse * (dot(to_s.xyz, origin) + to_s.w);
    const vec3 x = origin + t * direction;
    const float a = dot(to_u.xyz, x) + to_u.w, b = dot(to_v.xyz, x) + to_v.w;
    const float w = max(abs(wu), abs(wv));
    // Rounding of the coordinates, along and across the patch.
    const float rounding = 16.0 * CORE_FLOAT_ROUNDOFF * (far + abs(t) * size);
    const float dual = max(abs(to_u.x) + abs(to_u.y) + abs(to_u.z), abs(to_v.x) + abs(to_v.y) + abs(to_v.z));
    const float high = bounds.y + 2.0 * rounding;
    const float error = bounds.x + w * high + dual * rounding + 1e-6;
    const float reach_t = abs(inverse) * high + rounding;
    // The sum a + b is off by both.
    const float outside = max(abs(a), abs(b)) - 1.0 - error;
    const bool is_diagonal = (more.w >> 31) != 0u;
    const bool is_outside = outside > 0.0 || (is_diagonal && a + b > 2.0 * error) || t - reach_t > most_t || t + reach_t < least_t;
    core_patch_meeting meeting;
    meeting.is_met = is_parallel || !is_outside;
    meeting.slope = bounds.z + w * bounds.w;
    meeting.bend = uintBitsToFloat(more.x) + w * uintBitsToFloat(more.y);
    meeting.is_single = !is_parallel && meeting.slope < 0.5;
    meeting.a = a;
    meeting.b = b;
    return meeting;
}

// Bound of the error of Newton's prediction after a step of this length: the solution is at most (1 + L)/(1 - L) steps away, and
// the rest of the linearization is its square times the bend, over the smallest stretching 1 - L.
elvis_real core_patch_prediction_error(float slope, float bend, elvis_real step) {
    const elvis_real room = elvis_real(1) / (elvis_real(1) - elvis_real(slope));
    const elvis_real distance = (elvis_real(1) + elvis_real(slope)) * room * step;
    return elvis_real(bend) * room * distance * distance;
}
