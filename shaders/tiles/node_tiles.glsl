// List of hierarchy nodes of a tile: their number, then the nodes. Width and height come from the host.

// A tile of an even mesh touches some ten boxes; beyond this, entries are inner nodes.
#define CORE_TILE_CAPACITY 31u
#define CORE_TILE_STRIDE 32u
