// How far elements reach beyond their faces (cut_surface/reach.glsl).
//
// In the linearized coordinates y of a point of the element, let E(y) = n . y + w be the constraint of a face; n . xi + w <= 0 in the
// element. Around a point a of it y = y(a) + A (xi - a) + e with |n . e| <= B |xi - a|^2 / 2, so that in a cube around it, no point of which
// is farther away than r,
//
//     E(y) <= E(y(a)) + |n A| r + B r^2 / 2   and   E(y) <= n . (y(a) - a) + |n A - n| r + B r^2 / 2,
//
// with sums of absolute values. The element is divided until the lower of the two is hardly more than what was seen. B is measured on
// ways from the centroid, as curvatures are (element/measured_curvature.glsl).
//
// A work group is an element, an invocation a part of it.

layout(local_size_x = 64) in;

#include "arithmetic/precision.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_input { uint core_wanted[]; };
// Three words an element.
layout(set = 0, binding = 1, std430) writeonly buffer core_output { uint core_words[]; };

#include "arithmetic/finite.glsl"
#include "element/element_frame.glsl"
#include "cut_surface/reach.glsl"
#include "isosurface/octant_parts.glsl"

#define CORE_PARTS 64u
// Ways from the centroid: to corners, and to middles of edges and faces of the cube around the shape; and points on each.
#define CORE_WAYS 27u
#define CORE_STAGES 2u
// Slopes are measured between points, and are steeper elsewhere.
#define CORE_BEND_SAFETY elvis_real(2)
// A bound that is this much above what was seen is good enough.
#define CORE_REACH_TOLERANCE elvis_real(0.03LF)
#define CORE_FIRST_LEVEL 2u
#define CORE_MOST_LEVELS 4u

// Of each face: what was seen, B, and the bound.
elvis_real core_seen[CORE_REACHES], core_bend[CORE_REACHES], core_reach[CORE_REACHES];
uint core_stack[8u * (CORE_MOST_LEVELS - CORE_FIRST_LEVEL)];
// What each invocation has found, and the most of that.
shared float core_found[CORE_PARTS][2 * CORE_REACHES], core_most[2 * CORE_REACHES];

struct core_linear_point {
    elvis_vec3 y;
    // With the reference coordinates.
    elvis_mat3 change;
};

core_linear_point core_linear_point_at(core_linearization linearization, uint element, elvis_vec3 xi) {
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, position, jacobian);
    core_linear_point point;
    point.y = elvis_vec3(core_linear_inverse(linearization, vec3(position)));
    for (int k = 0; k < 3; ++k) {
        point.change[k] = elvis_vec3(core_linear_motion(linearization, vec3(jacobian[k])));
    }
    return point;
}

elvis_real core_sum(elvis_vec3 v) { return dot(abs(v), elvis_vec3(1)); }

elvis_vec3 core_slope(elvis_mat3 change, elvis_vec3 normal) { return normal * change; }

// Along one way.
void core_measure(core_linearization linearization, uint element, uint way) {
    const elvis_vec3 end = core_projected(elvis_vec3(elvis_real(way % 3u), elvis_real(way / 3u % 3u), elvis_real(way / 9u)) - elvis_real(1));
    const elvis_vec3 stride = (end - CORE_CENTROID) / elvis_real(CORE_STAGES);
    const elvis_real distance = core_max_norm(stride);
    elvis_mat3 before = core_linear_point_at(linearization, element, CORE_CENTROID).change;
    for (uint stage = 1u; stage <= CORE_STAGES; ++stage) {
        const core_linear_point point = core_linear_point_at(linearization, element, CORE_CENTROID + elvis_real(stage) * stride);
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const elvis_vec4 constraint = core_face_constraint(face);
            const elvis_real turn = core_sum(core_slope(point.change, constraint.xyz) - core_slope(before, constraint.xyz));
            core_seen[face] = max(core_seen[face], dot(constraint.xyz, point.y) + constraint.w);
            const elvis_real bend = distance > elvis_real(0) ? CORE_BEND_SAFETY * turn / distance : elvis_real(0);
            core_bend[face] = max(core_bend[face], core_is_finite(bend) ? bend : elvis_real(CORE_UNKNOWN_REACH));
        }
        before = point.change;
    }
}

// Whether it is to be divided; else its bounds count.
bool core_look_at_part(core_linearization linearization, uint element, uint code) {
    const elvis_vec3 middle = elvis_vec3(core_octant_middle(code)), xi = core_projected(middle);
    const elvis_real half_side = elvis_real(core_octant_half_side(code)), r = half_side + core_max_norm(middle - xi);
    const core_linear_point point = core_linear_point_at(linearization, element, xi);
#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    // At the apex Jacobians may jump.
    const elvis_real farthest = middle.z + half_side >= elvis_real(1) ? elvis_real(2) : r;
#else
    const elvis_real farthest = r;
#endif
    elvis_real bounds[CORE_REACHES];
    bool is_divided = false;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_vec3 slope = core_slope(point.change, constraint.xyz);
        const elvis_real seen = dot(constraint.xyz, point.y) + constraint.w, departure = dot(constraint.xyz, point.y - xi);
        bounds[face] = elvis_real(0.5LF) * core_bend[face] * r * farthest +
                       min(seen + core_sum(slope) * r, departure + core_sum(slope - constraint.xyz) * r);
        core_seen[face] = max(core_seen[face], seen);
        is_divided = is_divided || !(bounds[face] <= core_seen[face] + CORE_REACH_TOLERANCE);
    }
    is_divided = is_divided && (code & 7u) < CORE_MOST_LEVELS;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_real bound = core_is_finite(bounds[face]) ? bounds[face] : elvis_real(CORE_UNKNOWN_REACH);
        core_reach[face] = is_divided ? core_reach[face] : max(core_reach[face], bound);
    }
    return is_divided;
}

void core_bound_in_part(core_linearization linearization, uint element, uint code) {
    core_stack[0] = code;
    uint stack_size = core_is_in_shape(code) ? 1u : 0u;
    while (stack_size > 0u) {
        stack_size -= 1u;
        const uint part = core_stack[stack_size];
        if (core_look_at_part(linearization, element, part)) {
            for (uint eighth = 0u; eighth < 8u; ++eighth) {
                const uint smaller = core_octant_part(part, eighth);
                core_stack[stack_size] = smaller;
                stack_size += core_is_in_shape(smaller) ? 1u : 0u;
            }
        }
    }
}

// Of the first invocations.
void core_find_most(uint part, uint n_parts) {
    barrier();
    if (part < 2u * uint(CORE_REACHES)) {
        float most = core_found[0][part];
        for (uint other = 1u; other < n_parts; ++other) {
            most = max(most, core_found[other][part]);
        }
        core_most[part] = most;
    }
    barrier();
}

void main() {
    const uint part = gl_LocalInvocationID.x, element = core_wanted[gl_WorkGroupID.x];
    const core_linearization linearization = core_fetch_linearization(element);
    const bool is_bent = linearization.exponents != 0u && core_curvature(linearization.exponents) > CORE_LEAST_BENT;
    for (int face = 0; face < CORE_REACHES; ++face) {
        core_seen[face] = elvis_real(-2);
        core_reach[face] = is_bent ? elvis_real(-2) : elvis_real(CORE_UNKNOWN_REACH);
        core_bend[face] = elvis_real(0);
    }
    if (is_bent && part < CORE_WAYS) {
        core_measure(linearization, element, part);
    }
    for (int face = 0; face < CORE_REACHES; ++face) {
        core_found[part][face] = float(core_seen[face]);
        core_found[part][CORE_REACHES + face] = float(core_bend[face]);
    }
    core_find_most(part, CORE_WAYS);
    for (int face = 0; face < CORE_REACHES; ++face) {
        core_seen[face] = elvis_real(core_most[face]);
        core_bend[face] = elvis_real(core_most[CORE_REACHES + face]);
    }
    if (is_bent) {
        const uint place = part & 3u | (part >> 2 & 3u) << CORE_OCTANT_PLACE_BITS | (part >> 4) << (2 * CORE_OCTANT_PLACE_BITS);
        core_bound_in_part(linearization, element, CORE_FIRST_LEVEL | place << 3);
    }
    for (int face = 0; face < CORE_REACHES; ++face) {
        core_found[part][face] = float(core_reach[face]);
    }
    core_find_most(part, CORE_PARTS);
    if (part < 3u) {
        core_words[3u * gl_WorkGroupID.x + part] = core_pack_reaches(core_most[2u * part], core_most[2u * part + 1u]);
    }
}
