// Cubes of reference coordinates, each cut in eight or left for the next one: a search through an octree that needs no stack.

#ifndef CORE_OCTREE_BOX
#define CORE_OCTREE_BOX

// A cube: its place among those of its level, in 2^level of each direction. The one of level 0 surrounds the shape.
struct core_octree_box {
    uint x, y, z, level;
    bool is_last;
};

core_octree_box core_whole_box() { return core_octree_box(0u, 0u, 0u, 0u, false); }

elvis_real core_half_side(const core_octree_box box) { return exp2(-float(box.level)); }

elvis_vec3 core_middle(const core_octree_box box) {
    return elvis_vec3(-1) + core_half_side(box) * elvis_vec3(2u * box.x + 1u, 2u * box.y + 1u, 2u * box.z + 1u);
}

void core_cut_box(inout core_octree_box box) {
    box.x *= 2u;
    box.y *= 2u;
    box.z *= 2u;
    box.level += 1u;
}

// To the next one that is not in this one.
void core_leave_box(inout core_octree_box box) {
    // As often as all three numbers end in ones, it is the last in the one around it.
    const uint ones = uint(findLSB(~(box.x & box.y & box.z))), up = min(ones, box.level);
    box.level -= up;
    box.is_last = box.level == 0u;
    const uint x = box.x >> up, y = box.y >> up, z = box.z >> up;
    const uint next = ((x & 1u) | (y & 1u) << 1u | (z & 1u) << 2u) + 1u;
    box.x = (x & ~1u) | (next & 1u);
    box.y = (y & ~1u) | (next >> 1u & 1u);
    box.z = (z & ~1u) | (next >> 2u & 1u);
}

#endif
