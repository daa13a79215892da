// The way to octants that may hold a point, from those that wait on the stack (cut_surface/octant_roots.glsl).

#define CORE_NO_OCTANT 0x80000000u

core_node core_fetch_octant_node(uint index) {
    const uvec4 first = elvis_fetch4_core_octant_nodes(index, 0u);
    const uvec4 second = elvis_fetch4_core_octant_nodes(index, 1u);
    return core_node(uintBitsToFloat(first.xyz), uintBitsToFloat(second.xyz), first.w, second.w != 0u);
}

// A leaf of the octants' hierarchies that holds the point, a part of an octant, or CORE_NO_OCTANT.
uint core_next_octant(vec3 in_hierarchy, float box_tolerance, inout core_octant_search search) {
    uint next = CORE_NO_OCTANT;
    while (search.stack_size > 0u) {
        search.stack_size -= 1u;
        search.work += 1u;
        const uint word = core_stack[search.stack_size];
        const bool is_part = (word & CORE_OCTANT_PART) != 0u;
        const core_node node = core_fetch_octant_node(is_part ? 0u : word);
        const bool is_touched = !is_part && core_contains(node, in_hierarchy, box_tolerance);
        if (is_touched && !node.is_leaf) {
            core_stack[search.stack_size] = node.child + 1u;
            core_stack[search.stack_size + 1u] = node.child;
            search.stack_size += 2u;
        }
        next = is_part ? word : is_touched && node.is_leaf ? node.child : CORE_NO_OCTANT;
        if (next != CORE_NO_OCTANT || search.stack_size == 0u) {
            break;
        }
    }
    return next;
}

struct core_octant_guess {
    // Local coordinates of the octant, by its linear model; and whether that does not say that the octant lacks the point.
    vec3 y;
    bool may_hold;
};

core_octant_guess core_guess_in(const core_octant octant, core_cut_point point, vec3 in_hierarchy) {
    const float far = max(max(abs(in_hierarchy.x), abs(in_hierarchy.y)), abs(in_hierarchy.z));
    const float tolerance = core_octant_tolerance(octant, far + float(point.error) / float(CORE_OCTANT_ROUNDING));
    const vec3 y = octant.size > 0.0 ? core_octant_rotate(octant, in_hierarchy - octant.middle) : vec3(0);
    return core_octant_guess(y, max(max(abs(y.x), abs(y.y)), abs(y.z)) <= 1.0 + tolerance);
}
