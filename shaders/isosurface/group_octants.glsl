// The octants that the rays of one work group can meet, and which of them one ray can.
//
// A tile's list (tiles/ray_tiles.comp) is of many rows of pixels. The group takes over what its own few rows can meet, one entry an
// invocation at a time. Then each ray tells which of 32 entries it can meet: all look at the same one, so none waits for others.
//
// The kernel brings core_tiles, picture/pixel_ray.glsl, tiles/ray_tiles.glsl and isosurface/isovalues.glsl.

#include "isosurface/octant_span.glsl"
#include "isosurface/octant_frustum.glsl"

#define CORE_OCTANTS_AHEAD 32u
#define CORE_MASKS ((CORE_TILE_CAPACITY + 31u) / 32u)

// Of each entry of the tile's list, a bit: the group takes it over.
shared uint core_taken[CORE_MASKS];
shared uint core_group_words[CORE_TILE_CAPACITY];
shared float core_group_enter_t[CORE_TILE_CAPACITY];

// Number of entries before `end` that are taken over.
uint core_n_taken(uint end) {
    uint n = 0u;
    for (uint i = 0u; i < CORE_MASKS; ++i) {
        const uint n_bits = clamp(end, 32u * i, 32u * i + 32u) - 32u * i;
        n += n_bits == 0u ? 0u : uint(bitCount(core_taken[i] << (32u - n_bits)));
    }
    return n;
}

// From the list of `n_listed` entries at `list` to core_group_words and core_group_enter_t, in its order; returns their number.
// `column`, `row`: the group's first pixel. All of the group's invocations come here together.
uint core_take_octants(uint list, uint n_listed, uint column, uint row) {
    const uint lane = gl_LocalInvocationID.x;
    const core_frustum frustum = core_tile_frustum(elvis_real(column), elvis_real(row), CORE_TILE_WIDTH, CORE_ROWS);
    for (uint i = lane; i < CORE_MASKS; i += CORE_TILE_WIDTH) {
        core_taken[i] = 0u;
    }
    barrier();
    for (uint i = lane; i < n_listed; i += CORE_TILE_WIDTH) {
        const uint word = CORE_WORD(core_tiles, list + 1u + 2u * i);
        const bool is_inner = (word & CORE_TILE_INNER) != 0u;
        const vec2 span = vec2(uintBitsToFloat(CORE_WORD(core_tiles, list + 2u + 2u * i)), 3e38);
        const bool is_met = core_frustum_meets_isovalue(core_fetch_octant(is_inner ? 0u : word), frustum, span);
        atomicOr(core_taken[i / 32u], is_inner || is_met ? 1u << (i % 32u) : 0u);
    }
    barrier();
    for (uint i = lane; i < n_listed; i += CORE_TILE_WIDTH) {
        if ((core_taken[i / 32u] >> (i % 32u) & 1u) != 0u) {
            const uint place = core_n_taken(i);
            core_group_words[place] = CORE_WORD(core_tiles, list + 1u + 2u * i);
            core_group_enter_t[place] = uintBitsToFloat(CORE_WORD(core_tiles, list + 2u + 2u * i));
        }
    }
    barrier();
    return core_n_taken(n_listed);
}

// Of the group's entries from `first` to before `end`, at most CORE_OCTANTS_AHEAD, those that have to be looked into, as bits: inner nodes,
// and octants in which the ray can meet an isovalue before `end_t`, or where estimates alone say that it does not.
uint core_octants_ahead(core_ray ray, uint first, uint end, float end_t) {
    uint ahead = 0u, i = first;
    while (i < end) {
        const uint word = core_group_words[i];
        const bool is_inner = (word & CORE_TILE_INNER) != 0u;
        const core_octant octant = core_fetch_octant(is_inner ? 0u : word);
        const core_octant_span found = core_octant_span_of(octant, ray, end_t);
        const bool is_wanted = is_inner || (found.is_inside && (found.is_met || (octant.code & CORE_OCTANT_ESTIMATED) != 0u));
        ahead |= is_wanted ? 1u << (i - first) : 0u;
        i += 1u;
        if (i >= end) {
            break;
        }
    }
    return ahead;
}
