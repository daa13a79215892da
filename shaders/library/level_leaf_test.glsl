// Whether the rays of a tile can meet an isovalue in a cell; for kernels/ray_tiles.comp.

#include "library/samples.glsl"
#include "library/level_cell.glsl"

layout(std430, set = 0, binding = 3) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };

#include "library/isovalues.glsl"

// Points of the tile's rays between t = span.x and span.y lie in the hull of eight: each is linear in t, in column and in row.
bool core_leaf_is_met(uint item, core_beam beam, vec2 span) {
    core_begin_isovalues();
    const core_level_cell cell = core_fetch_level_cell(item);
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    float least = 3e38, most = -3e38, far = 0.0;
    vec3 low = vec3(3e38), high = vec3(-3e38);
    for (int corner = 0; corner < 4; ++corner) {
        const vec3 origin = beam.origins[corner] + shift;
        const vec3 start = core_cell_turn(cell, origin - cell.middle), motion = core_cell_turn(cell, beam.directions[corner]);
        const vec3 a = start + span.x * motion, b = start + span.y * motion;
        low = min(low, min(a, b));
        high = max(high, max(a, b));
        const float value_a = dot(cell.slope, a), value_b = dot(cell.slope, b);
        least = min(least, min(value_a, value_b));
        most = max(most, max(value_a, value_b));
        const vec3 size = abs(origin) + abs(shift);
        far = max(far, max(max(size.x, size.y), size.z));
    }
    const float tolerance = core_cell_tolerance(cell, far);
    const vec3 beyond = max(low, -high);
    const bool is_outside = max(max(beyond.x, beyond.y), beyond.z) > 1.0 + tolerance;
    const float error = core_cell_error(cell, tolerance) + 16.0 * CORE_FLOAT_ROUNDOFF * (abs(cell.value) + abs(least) + abs(most));
    const uint first = core_isovalue_from(elvis_real(cell.value + least - error));
    const bool can_hold = !(error < CORE_LEVEL_UNKNOWN) ||
                          (first < CORE_N_ISOVALUES &&
                           float(core_isovalue_at(min(first, CORE_N_ISOVALUES - 1u))) <= cell.value + most + error);
    // What rests on estimates is left to the pixels, which flag it.
    return (can_hold || (cell.code & CORE_CELL_ESTIMATED) != 0u) && !is_outside;
}
