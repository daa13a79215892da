// List of what a tile of pixels can see of a hierarchy (over patches of faces, or elements): the number of entries (and the highest bit
// if there are inner nodes among them), then for each one a word (a patch, or an inner node with the highest bit set) and the least t at
// which a ray may meet it, as bits of a float. By ascending t.

#ifndef CORE_TILE_CAPACITY
#define CORE_TILE_CAPACITY 31u
#endif
#define CORE_TILE_STRIDE (2u * CORE_TILE_CAPACITY + 2u)
#define CORE_TILE_INNER 0x80000000u
