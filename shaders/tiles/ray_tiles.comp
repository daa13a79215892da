// For each tile of pixels, what its rays can meet of a hierarchy (over patches of faces, or elements). Neighbouring pixels share most of
// their way through the hierarchy: it is descended once for all of them.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/hierarchy.glsl"
#include "tiles/ray_tiles.glsl"
#include "arithmetic/driver_limit.glsl"

// What stands for a leaf: its item, or the node.
#ifndef CORE_LEAF_WORD
#define CORE_LEAF_WORD node.child
#endif

layout(std430, set = 0, binding = 1) writeonly buffer core_output { uint core_tiles[]; };
layout(push_constant) uniform core_constants {
    uint core_tiles_per_row;
    // Of the whole picture; and those that lists are wanted of.
    uint core_n_tiles;
    uint core_first_tile, core_end_tile;
#ifdef CORE_TESTS_ISOVALUES
    uint core_n_isovalues;
#endif
};
#ifdef CORE_LISTS_TILES
#define CORE_LISTED_BINDING 2
#include "tiles/list_tile.glsl"
#endif
#ifdef CORE_TESTS_STARTS
// Not 0 for tiles with a list, in this class or another.
layout(std430, set = 0, binding = 2) buffer core_has_starts_block { uint core_has_starts[]; };
#endif

#include "tiles/tile_frustum.glsl"

#ifdef CORE_TESTS_ISOVALUES
#include "isosurface/octant_leaf_test.glsl"
#elif defined(CORE_TESTS_STARTS)
#include "segments/walk_leaf_test.glsl"
#else
bool core_leaf_is_met(uint item, core_frustum frustum, vec2 span) { return true; }
#endif

// The tile's list, by ascending enter_t.
uint core_words[CORE_TILE_CAPACITY];
float core_enter_t[CORE_TILE_CAPACITY];

void core_insert(uint n_entries, uint word, float enter_t) {
    uint place = n_entries;
    while (place > 0u && core_enter_t[max(place, 1u) - 1u] > enter_t) {
        core_enter_t[place] = core_enter_t[place - 1u];
        core_words[place] = core_words[place - 1u];
        place -= 1u;
    }
    core_enter_t[place] = enter_t;
    core_words[place] = word;
}

// `n_inner`: of the entries, how many are inner nodes.
void core_write_list(uint tile, bool is_wanted, uint n_entries, uint n_inner) {
    const uint first = tile * CORE_TILE_STRIDE;
    if (is_wanted) {
        core_tiles[first] = n_entries | (n_inner > 0u ? CORE_TILE_INNER : 0u);
#ifdef CORE_TESTS_STARTS
        core_has_starts[tile] |= n_entries;
#endif
    }
    for (uint i = 0u; i < n_entries; ++i) {
        core_tiles[first + 1u + 2u * i] = core_words[i];
        core_tiles[first + 2u + 2u * i] = floatBitsToUint(core_enter_t[i]);
    }
#ifdef CORE_LISTS_TILES
    if (n_entries > 0u) {
        core_list_tile(tile, n_inner > 0u ? 1u : 0u, core_n_tiles);
    }
#endif
}

void main() {
    const uint tile = core_first_tile + gl_GlobalInvocationID.x;
    const bool is_wanted = tile < core_end_tile;
    const core_frustum frustum = core_tile_frustum(elvis_real((tile % core_tiles_per_row) * CORE_TILE_WIDTH),
                                          elvis_real((tile / core_tiles_per_row) * CORE_TILE_HEIGHT), CORE_TILE_WIDTH,
                                          CORE_TILE_HEIGHT);
    uint stack[CORE_STACK_SIZE];
    uint stack_size = is_wanted ? 1u : 0u;
    stack[0] = 0u;
    uint n_entries = 0u, n_inner = 0u;
    while (stack_size > 0u) {
        stack_size -= 1u;
        const uint index = stack[stack_size];
        const core_node node = core_fetch_node(index);
        const vec2 span = core_frustum_span(node, frustum);
        bool is_met = span.x < 3.2e38;
        if (is_met && node.is_leaf) {
            is_met = core_leaf_is_met(node.child, frustum, span);
        }
        // A node that could leave too many entries behind stays an entry itself, for the pixels to descend from.
        const bool is_entry = node.is_leaf || n_entries + stack_size + 2u > CORE_TILE_CAPACITY;
        if (is_met && is_entry) {
            core_insert(n_entries, node.is_leaf ? CORE_LEAF_WORD : index | CORE_TILE_INNER, span.x);
            n_entries += 1u;
            n_inner += node.is_leaf ? 0u : 1u;
        }
        if (is_met && !is_entry) {
            // The nearer one first, so that far ones stay unopened where there are too many.
            const core_node one = core_fetch_node(node.child), other = core_fetch_node(node.child + 1u);
            const bool is_first_nearer = dot(frustum.axis, one.lower + one.upper) < dot(frustum.axis, other.lower + other.upper);
            stack[stack_size] = node.child + (is_first_nearer ? 1u : 0u);
            stack[stack_size + 1u] = node.child + (is_first_nearer ? 0u : 1u);
            stack_size += 2u;
        }
        if (stack_size == 0u) {
            break;
        }
    }
    // Then pixels descend from the root.
    const bool is_cut_short = is_wanted && (stack_size > 0u || core_has_driver_given_up(core_end_tile >> 31));
    core_words[0] = is_cut_short ? CORE_TILE_INNER : core_words[0];
    core_enter_t[0] = is_cut_short ? -3e38 : core_enter_t[0];
    core_write_list(tile, is_wanted, is_cut_short ? 1u : n_entries, is_cut_short ? 1u : n_inner);
}
