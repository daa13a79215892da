// Whether the rays of a tile can meet an isovalue in an element; for kernels/ray_tiles.comp.

#include "library/samples.glsl"
#include "library/linearization.glsl"
#include "library/shape_region.glsl"
#include "library/level_model.glsl"

layout(std430, set = 0, binding = 3) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };

#include "library/isovalues.glsl"
#include "library/level_span.glsl"

// Points of the tile's rays between t = span.x and span.y lie in the hull of eight: each is linear in t, in column and in row.
bool core_leaf_is_met(uint element, core_beam beam, vec2 span) {
    core_begin_isovalues();
    const core_linearization linearization = core_fetch_linearization(element);
    const core_level_model model = core_fetch_level_model(element);
    const float beyond = core_linear_error(float(elvis_fetch_core_curvatures(element, 0u)));
    const vec3 shift = vec3(core_reference.xyz - elvis_origin(element));
    float least = 3e38, most = -3e38;
    float excesses[CORE_N_FACES];
    for (int face = 0; face < CORE_N_FACES; ++face) {
        excesses[face] = 3e38;
    }
    for (int corner = 0; corner < 8; ++corner) {
        const float t = (corner & 1) == 0 ? span.x : span.y;
        const vec3 xi = core_linear_inverse(linearization, shift + beam.origins[corner >> 1] + t * beam.directions[corner >> 1]);
        const float value = model.value + dot(model.slope, xi - vec3(CORE_CENTROID));
        least = min(least, value);
        most = max(most, value);
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const vec4 constraint = vec4(core_face_constraint(face));
            excesses[face] = min(excesses[face], dot(constraint.xyz, xi) + constraint.w);
        }
    }
    bool is_outside = false;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        is_outside = is_outside || excesses[face] > float(CORE_CONSTRAINT_NORM) * beyond;
    }
    const float error = core_level_error(model, beyond) + 16.0 * CORE_FLOAT_ROUNDOFF * (abs(least) + abs(most));
    const uint first = core_isovalue_from(elvis_real(least - error));
    const bool can_hold = !(error < CORE_LEVEL_UNKNOWN) ||
                          (first < CORE_N_ISOVALUES && float(core_isovalue_at(min(first, CORE_N_ISOVALUES - 1u))) <= most + error);
    // What rests on estimates is left to the pixels, which flag it.
    return linearization.exponents == 0u || ((can_hold || model.is_estimated) && !is_outside);
}
