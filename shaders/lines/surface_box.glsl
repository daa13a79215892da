// A box around a pixel's part of a surface, in the coordinates of the hierarchy. The kernel brings tiles/hierarchy.glsl.

#include "picture/view.glsl"

struct core_box {
    vec3 lower, upper;
    // Of the corners alone.
    float diagonal;
};

// Around all between the corners, which have this error, and a share of the diagonal more.
core_box core_box_around(core_cut_square corners, elvis_real error, float share) {
    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(corners.corner0) + in_hierarchy, q1 = vec3(corners.corner1) + in_hierarchy;
    const vec3 q2 = vec3(corners.corner2) + in_hierarchy, q3 = vec3(corners.corner3) + in_hierarchy;
    const vec3 lowest = min(min(q0, q1), min(q2, q3)), highest = max(max(q0, q1), max(q2, q3));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(in_hierarchy);
    const float diagonal = length(highest - lowest);
    const float margin = 2.0 * float(error) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z) + share * diagonal;
    return core_box(lowest - margin, highest + margin, diagonal);
}

// For lines/line_search.glsl.
#define core_reaches(surface, node) core_overlaps(node, surface.box.lower, surface.box.upper)
