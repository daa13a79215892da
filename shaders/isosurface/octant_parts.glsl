// Eighths of octants (isosurface/octant.glsl).

#ifndef CORE_OCTANT_PARTS
#define CORE_OCTANT_PARTS

#include "element/shape_region.glsl"
#include "isosurface/octant.glsl"

uint core_octant_part(uint code, uint eighth) {
    const uint mask = (1u << CORE_OCTANT_PLACE_BITS) - 1u;
    uint part = (code & 7u) + 1u;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint shift = 3u + axis * uint(CORE_OCTANT_PLACE_BITS);
        part |= (2u * ((code >> shift) & mask) + ((eighth >> axis) & 1u)) << shift;
    }
    return part;
}

// Whether it has more than an edge in common with the shape.
bool core_is_in_shape(uint code) {
    // Near the corner that is deepest in the shape.
    const elvis_vec3 deepest = elvis_vec3(core_octant_middle(code) - 0.99 * core_octant_half_side(code));
    return core_excess(deepest.x, deepest.y, deepest.z) < elvis_real(0);
}

#endif
