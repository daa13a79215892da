// Descent through a bounding volume hierarchy (core/hierarchy/hierarchy.hpp) for point location.
//
// Nodes come from the host's buffer core_nodes: two rows of four words, bounds as bits of floats. Bounds are in single precision
// in every kernel; they are rounded outward, and what the point loses by rounding is given back as a tolerance.

#define CORE_NO_NODE 0xffffffffu

// Arrays of this many words lie in memory. Mesa's RADV keeps arrays of up to 256 bytes in registers, one for each word, as long as they
// live, and goes through all of them at each access.
#define CORE_WORDS_IN_MEMORY 65
// Hierarchy::max_depth inner nodes can each leave one sibling behind: 61.
#define CORE_STACK_SIZE CORE_WORDS_IN_MEMORY

struct core_node {
    vec3 lower;
    vec3 upper;
    // Inner node: first of two adjacent children. Leaf: the item.
    uint child;
    bool is_leaf;
};

core_node core_fetch_node(uint index) {
    const uvec4 first = elvis_fetch4_core_nodes(index, 0u);
    const uvec4 second = elvis_fetch4_core_nodes(index, 1u);
    return core_node(uintBitsToFloat(first.xyz), uintBitsToFloat(second.xyz), first.w, second.w != 0u);
}

bool core_contains(core_node node, vec3 point, float tolerance) {
    const vec3 outside = max(node.lower - point, point - node.upper);
    return max(max(outside.x, outside.y), outside.z) <= tolerance;
}

bool core_overlaps(core_node node, vec3 lower, vec3 upper) {
    const vec3 outside = max(node.lower - upper, lower - node.upper);
    return max(max(outside.x, outside.y), outside.z) <= 0.0;
}
