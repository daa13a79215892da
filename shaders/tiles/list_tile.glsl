// Puts tiles that see something into a list, from which they are drawn (tiles/listed_tile.glsl). The kernel brings
// CORE_LISTED_BINDING.

// Two lists: how many tiles each has; those of the first, and from the end those of the second.
layout(set = 0, binding = CORE_LISTED_BINDING, std430) buffer core_listed_block { uint core_listed[]; };

// `list`: 0 or 1. `n_tiles`: of the whole picture, for which there is room.
void core_list_tile(uint tile, uint list, uint n_tiles) {
    const uint place = atomicAdd(core_listed[list], 1u);
    core_listed[list == 0u ? 2u + place : 1u + n_tiles - place] = tile;
}
