// For each tile of pixels, what its rays can meet of a hierarchy (over patches of faces, or elements): neighbouring pixels share most of their way
// through the hierarchy, so it is gone once for all of them.

layout(local_size_x = 32) in;

#include "library/precision.glsl"
#include "library/cut_frame.glsl"
#include "library/hierarchy.glsl"
#include "library/ray_tiles.glsl"

// What stands for a leaf: its item, or the node.
#ifndef CORE_LEAF_WORD
#define CORE_LEAF_WORD node.child
#endif

layout(std430, set = 0, binding = 1) writeonly buffer core_output { uint core_tiles[]; };
// Number 4: tiles with inner nodes.
layout(std430, set = 0, binding = 2) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_constants {
    uint core_tiles_per_row;
    uint core_n_tiles;
#ifdef CORE_TESTS_LEVELS
    uint core_n_isovalues;
#endif
};
#ifdef CORE_TESTS_STARTS
// Not 0 for tiles with a list, in this class or another.
layout(std430, set = 0, binding = 3) buffer core_has_starts_block { uint core_has_starts[]; };
#endif

// The rays of a tile lie between four planes; each is given by a point, its normal inwards, and the sizes of both for rounding.
struct core_beam {
    // Relative to base, which all planes are near.
    vec3 left, right, top, bottom;
    vec3 at_left, at_right, at_top, at_bottom;
    vec3 axis;
    float axis_offset, eye_t;
    // The rays at the corners, relative to the reference point.
    vec3 origins[4], directions[4];
};

bool core_is_beyond(core_node node, vec3 normal, vec3 point) {
    const vec3 farthest = mix(node.lower, node.upper, greaterThan(normal, vec3(0)));
    const vec3 sizes = max(abs(node.lower), abs(node.upper)) + abs(point);
    const float rounding = 16.0 * CORE_FLOAT_ROUNDOFF * max(max(sizes.x, sizes.y), sizes.z);
    return dot(normal, farthest - point) < -rounding * dot(abs(normal), vec3(1));
}

// Least and largest t in the box, a little farther apart; above every t if the beam does not meet it in front of the eye.
vec2 core_beam_span(core_node node, core_beam beam) {
    const vec3 middle = 0.5 * (node.lower + node.upper), half_size = 0.5 * (node.upper - node.lower);
    const float t = dot(beam.axis, middle) - beam.axis_offset, reach = dot(abs(beam.axis), half_size);
    const float size = dot(abs(beam.axis), abs(middle) + half_size) + abs(beam.axis_offset) + abs(t);
    const float slack = 16.0 * CORE_FLOAT_ROUNDOFF * size;
    const bool is_outside = t + reach + slack < beam.eye_t || core_is_beyond(node, beam.left, beam.at_left) ||
                            core_is_beyond(node, beam.right, beam.at_right) || core_is_beyond(node, beam.top, beam.at_top) ||
                            core_is_beyond(node, beam.bottom, beam.at_bottom);
    return is_outside ? vec2(3.3e38) : vec2(t - reach - slack, t + reach + slack);
}

core_beam core_tile_beam(elvis_real column, elvis_real row) {
    const core_cut_column left = core_cut_begin(column), right = core_cut_begin(column + elvis_real(CORE_TILE_WIDTH - 1u));
    const elvis_real first = row - left.row0, last = first + elvis_real(CORE_TILE_HEIGHT - 1u);
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    const vec3 across = normalize(vec3(core_base_column.xyz)), down = normalize(vec3(core_base_row.xyz));
    core_beam beam;
    beam.at_left = vec3((left.base + first * left.base_row).xyz) + shift;
    beam.at_right = vec3((right.base + last * right.base_row).xyz) + shift;
    beam.at_top = beam.at_left;
    beam.at_bottom = beam.at_right;
    const vec3 first_direction = vec3((left.direction + first * left.direction_row).xyz);
    const vec3 last_direction = vec3((right.direction + last * right.direction_row).xyz);
    // Rays of one column differ along `down` only, those of one row along `across`.
    const vec3 axis = cross(across, down);
    const float facing = sign(dot(axis, first_direction));
    beam.axis = facing * axis;
    beam.left = facing * cross(down, first_direction);
    beam.right = -facing * cross(down, last_direction);
    beam.top = -facing * cross(across, first_direction);
    beam.bottom = facing * cross(across, last_direction);
    beam.axis_offset = dot(beam.axis, vec3(core_base0.xyz) + shift);
    beam.eye_t = -float(core_reference.w);
    for (int corner = 0; corner < 4; ++corner) {
        const elvis_real down = corner < 2 ? first : last;
        beam.origins[corner] = vec3(((corner & 1) == 0 ? left.base : right.base).xyz + down * left.base_row.xyz);
        beam.directions[corner] = vec3(((corner & 1) == 0 ? left.direction : right.direction).xyz + down * left.direction_row.xyz);
    }
    return beam;
}

#ifdef CORE_TESTS_LEVELS
#include "library/level_leaf_test.glsl"
#elif defined(CORE_TESTS_STARTS)
#include "library/chain_leaf_test.glsl"
#else
bool core_leaf_is_met(uint item, core_beam beam, vec2 span) { return true; }
#endif

void main() {
    const uint tile = gl_GlobalInvocationID.x;
    const bool is_wanted = tile < core_n_tiles;
    const core_beam beam = core_tile_beam(elvis_real((tile % core_tiles_per_row) * CORE_TILE_WIDTH),
                                          elvis_real((tile / core_tiles_per_row) * CORE_TILE_HEIGHT));
    uint stack[CORE_STACK_SIZE];
    uint stack_size = is_wanted ? 1u : 0u;
    stack[0] = 0u;
    uint n_entries = 0u, n_inner = 0u;
    uint words[CORE_TILE_CAPACITY];
    float entries[CORE_TILE_CAPACITY];
    while (stack_size > 0u) {
        stack_size -= 1u;
        const uint index = stack[stack_size];
        const core_node node = core_fetch_node(index);
        const vec2 span = core_beam_span(node, beam);
        const float entry = span.x;
        bool is_met = entry < 3.2e38;
        if (is_met && node.is_leaf) {
            is_met = core_leaf_is_met(node.child, beam, span);
        }
        // A node that could leave too many entries behind stays an entry itself, for the pixels to descend from.
        const bool is_entry = node.is_leaf || n_entries + stack_size + 2u > CORE_TILE_CAPACITY;
        if (is_met && is_entry) {
            uint place = n_entries;
            while (place > 0u && entries[max(place, 1u) - 1u] > entry) {
                entries[place] = entries[place - 1u];
                words[place] = words[place - 1u];
                place -= 1u;
            }
            entries[place] = entry;
            words[place] = node.is_leaf ? CORE_LEAF_WORD : index | CORE_TILE_INNER;
            n_entries += 1u;
            n_inner += node.is_leaf ? 0u : 1u;
        }
        if (is_met && !is_entry) {
            // The nearer one first, so that far ones stay unopened where there are too many.
            const core_node one = core_fetch_node(node.child), other = core_fetch_node(node.child + 1u);
            const bool is_first_nearer = dot(beam.axis, one.lower + one.upper) < dot(beam.axis, other.lower + other.upper);
            stack[stack_size] = node.child + (is_first_nearer ? 1u : 0u);
            stack[stack_size + 1u] = node.child + (is_first_nearer ? 0u : 1u);
            stack_size += 2u;
        }
        if (stack_size == 0u) {
            break;
        }
    }
    const uint first = tile * CORE_TILE_STRIDE;
    if (is_wanted) {
        core_tiles[first] = n_entries | (n_inner > 0u ? CORE_TILE_INNER : 0u);
#ifdef CORE_TESTS_STARTS
        core_has_starts[tile] |= n_entries;
#endif
    }
    for (uint i = 0u; i < n_entries; ++i) {
        core_tiles[first + 1u + 2u * i] = words[i];
        core_tiles[first + 2u + 2u * i] = floatBitsToUint(entries[i]);
    }
    const uint all_inner = subgroupAdd(n_inner > 0u ? 1u : 0u);
    if (subgroupElect()) {
        atomicAdd(core_counts[4], all_inner);
    }
}
