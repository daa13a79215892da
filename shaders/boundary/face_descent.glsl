// The way of a ray through the list of its tile (tiles/ray_tiles.comp), front to back, and with CORE_DESCENDS from inner nodes in it
// down to patches.
//
// The kernel brings core_tiles, tiles/ray_tiles.glsl, tiles/hierarchy.glsl, picture/pixel_ray.glsl and boundary/face_rays.glsl.

struct core_face_descent {
    // Where the list begins, how many entries are looked at, and the next one.
    uint list, n_entries, entry;
    // Nodes and patches that wait.
    uint stack_size;
};

// A stack costs a quarter of the time even where it stays empty.
#if CORE_DESCENDS
#ifndef CORE_OTHER_WORDS
#define CORE_OTHER_WORDS 0
#endif
// Behind the stack, words that the kernel may use for other things.
uint core_stack[CORE_STACK_SIZE + CORE_OTHER_WORDS];
#define CORE_TOP core_stack[descent.stack_size - 1u]
#else
#define CORE_TOP 0u
#endif

bool core_has_more(core_face_descent descent) { return descent.stack_size > 0u || descent.entry < descent.n_entries; }

void core_end_if(bool ends, inout core_face_descent descent) {
    descent.entry = ends ? descent.n_entries : descent.entry;
    descent.stack_size = ends ? 0u : descent.stack_size;
}

// The next patch or inner node, if one is wanted. Returns CORE_NO_PATCH if nothing is left before `end_t`. It has the inner-node bit set,
// so callers must test it first.
uint core_next_word(bool is_wanted, float end_t, inout core_face_descent descent) {
    const bool is_popped = is_wanted && descent.stack_size > 0u, is_listed = is_wanted && !is_popped;
    const uint at = descent.list + 1u + 2u * min(descent.entry, max(descent.n_entries, 1u) - 1u);
    const bool is_behind = is_listed && uintBitsToFloat(CORE_WORD(core_tiles, at + 1u)) > end_t;
    const uint word = is_behind ? CORE_NO_PATCH : is_popped ? CORE_TOP : CORE_WORD(core_tiles, at);
    descent.entry = is_behind ? descent.n_entries : descent.entry + (is_listed ? 1u : 0u);
    descent.stack_size -= is_popped ? 1u : 0u;
    return word;
}

// From an inner node to those of its children that the ray meets before `end_t`: the nearer one first, or the second one.
void core_descend(uint word, core_ray ray, float end_t, bool goes_nearer_first, inout core_face_descent descent) {
#if CORE_DESCENDS
    if ((word & CORE_TILE_INNER) != 0u && word != CORE_NO_PATCH) {
        const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
        const core_node one = core_fetch_node(node.child), other = core_fetch_node(node.child + 1u);
        const float one_t = core_box_entry(one, ray), other_t = core_box_entry(other, ray);
        const uint one_word = one.is_leaf ? one.child : node.child | CORE_TILE_INNER;
        const uint other_word = other.is_leaf ? other.child : (node.child + 1u) | CORE_TILE_INNER;
        const bool is_one_first = goes_nearer_first && one_t <= other_t;
        core_stack[descent.stack_size] = is_one_first ? other_word : one_word;
        descent.stack_size += (is_one_first ? other_t : one_t) <= end_t ? 1u : 0u;
        core_stack[descent.stack_size] = is_one_first ? one_word : other_word;
        descent.stack_size += (is_one_first ? one_t : other_t) <= end_t ? 1u : 0u;
    }
#endif
}
