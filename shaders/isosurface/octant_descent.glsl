// The way of a ray through the octants of its work group, front to back, and with CORE_DESCENDS from inner nodes among them down to
// octants.
//
// The kernel brings isosurface/group_octants.glsl.

struct core_octant_descent {
    // How many entries the group has, how many of them the ray looks at, and the next one.
    uint n_listed, n_entries, entry;
    // The first of those that were looked ahead at; the last one is before `entry`.
    uint first;
    // Bit i is set if entry `first + i` must be examined.
    uint ahead;
    // Nodes that wait.
    uint stack_size;
};

// A stack costs a quarter of the time even where it stays empty.
#if CORE_DESCENDS
uint core_stack[CORE_STACK_SIZE];
#define CORE_TOP core_stack[descent.stack_size - 1u]
#else
#define CORE_TOP 0u
#endif

void core_look_ahead(const core_ray ray, float end_t, inout core_octant_descent descent) {
    descent.first = descent.entry;
    descent.entry = min(descent.first + CORE_OCTANTS_AHEAD, descent.n_entries);
    descent.ahead = core_octants_ahead(ray, descent.first, descent.entry, end_t);
}

bool core_has_octants_ahead(const core_octant_descent descent) { return descent.stack_size > 0u || descent.ahead != 0u; }

#if CORE_DESCENDS
// The octant of a node that the ray meets before `end_t`; CORE_NO_NODE if there are two children, which then wait.
uint core_octant_below(uint index, const core_ray ray, float end_t, inout core_octant_descent descent) {
    const core_node node = core_fetch_node(index);
    const vec2 in_box = core_box_span(node, ray);
    const bool is_met = max(in_box.x, float(ray.least_t)) <= min(in_box.y, end_t);
    if (is_met && !node.is_leaf) {
        core_stack[descent.stack_size] = (node.child + 1u) | CORE_TILE_INNER;
        core_stack[descent.stack_size + 1u] = node.child | CORE_TILE_INNER;
        descent.stack_size += 2u;
    }
    return is_met && node.is_leaf ? node.child : CORE_NO_NODE;
}
#endif

// The next octant; CORE_NO_NODE where an inner node comes first, or all that is left lies behind `end_t`.
uint core_next_octant(core_ray ray, float end_t, inout core_octant_descent descent) {
    const bool is_popped = descent.stack_size > 0u;
    const uint at = min(descent.first + uint(findLSB(descent.ahead | 1u << 31)), descent.n_listed - 1u);
    const bool is_behind = !is_popped && core_group_enter_t[at] > end_t;
    uint word = is_behind ? CORE_NO_NODE : is_popped ? CORE_TOP : core_group_words[at];
    descent.stack_size -= is_popped ? 1u : 0u;
    descent.ahead = is_popped ? descent.ahead : is_behind ? 0u : descent.ahead & (descent.ahead - 1u);
    descent.entry = is_behind ? descent.n_entries : descent.entry;
#if CORE_DESCENDS
    if ((word & CORE_TILE_INNER) != 0u && !is_behind) {
        word = core_octant_below(word & ~CORE_TILE_INNER, ray, end_t, descent);
    }
#endif
    return word;
}

// The same, but up to four nodes are passed in one iteration: drivers end loops by the number of their iterations.
uint core_seek_octant(core_ray ray, float end_t, inout core_octant_descent descent) {
    uint index = core_next_octant(ray, end_t, descent);
#if CORE_DESCENDS
    if (index == CORE_NO_NODE && core_has_octants_ahead(descent)) {
        index = core_next_octant(ray, end_t, descent);
    }
    if (index == CORE_NO_NODE && core_has_octants_ahead(descent)) {
        index = core_next_octant(ray, end_t, descent);
    }
    if (index == CORE_NO_NODE && core_has_octants_ahead(descent)) {
        index = core_next_octant(ray, end_t, descent);
    }
#endif
    return index;
}
