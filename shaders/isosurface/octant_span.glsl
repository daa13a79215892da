// Where along rays an isovalue can be met in a cell, as far as its linear models tell (isosurface/octant.glsl). Nothing is evaluated
// for it.

#include "isosurface/octant.glsl"
#include "isosurface/value_interval.glsl"

// `start` + t `motion`: the ray in the cell's coordinates. The part of `span` in the cell.
vec2 core_cell_inside(core_level_cell cell, vec3 start, vec3 motion, float tolerance, vec2 span) {
    const vec3 inverse = 1.0 / mix(motion, vec3(1e-30), lessThan(abs(motion), vec3(1e-30)));
    const vec3 a = (-1.0 - tolerance - start) * inverse, b = (1.0 + tolerance - start) * inverse;
    const vec3 low = min(a, b), high = max(a, b);
    span.x = max(span.x, max(max(low.x, low.y), low.z));
    span.y = min(span.y, min(min(high.x, high.y), high.z));
#if ELVIS_SHAPE != ELVIS_SHAPE_HEXAHEDRON
    // The cell is the part of an octant that lies in the shape.
    const float beyond = cell.size * (1.0 + tolerance) - core_cell_half_side(cell.code);
    const vec3 xi = core_cell_middle(cell.code) + cell.size * start, change = cell.size * motion;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const vec4 constraint = vec4(core_face_constraint(face));
        const float excess = dot(constraint.xyz, xi) + constraint.w - float(CORE_CONSTRAINT_NORM) * beyond;
        const float slope = dot(constraint.xyz, change);
        const float root = -excess / slope;
        span.y = slope > 0.0 && cell.size > 0.0 ? min(span.y, root) : span.y;
        span.x = slope < 0.0 && cell.size > 0.0 ? max(span.x, root) : span.x;
    }
#endif
    return span;
}

// The part of that in which the field leaves room for an isovalue.
vec2 core_cell_level_span(core_level_cell cell, vec3 start, vec3 motion, float tolerance, vec2 span) {
    return core_level_part(cell.value + dot(cell.slope, start), dot(cell.slope, motion), core_cell_error(cell, tolerance), span);
}

struct core_cell_part {
    // The ray goes through the cell before the end; it can meet an isovalue there.
    bool is_inside, is_met;
    vec2 span;
    // The span's middle.
    vec3 xi;
};

core_cell_part core_cell_part_of(core_level_cell cell, core_ray ray, float end_t) {
    const vec3 start = core_cell_turn(cell, ray.box_origin - cell.middle);
    const vec3 motion = core_cell_turn(cell, vec3(ray.direction));
    const float tolerance = core_cell_tolerance(cell, ray.far);
    const vec2 inside = core_cell_inside(cell, start, motion, tolerance, vec2(float(ray.least_t), end_t));
    core_cell_part part;
    part.span = core_cell_level_span(cell, start, motion, tolerance, inside);
    part.is_inside = inside.x <= inside.y;
    part.is_met = part.is_inside && part.span.x <= part.span.y;
    part.xi = core_cell_middle(cell.code) + cell.size * (start + 0.5 * (part.span.x + part.span.y) * motion);
    return part;
}
