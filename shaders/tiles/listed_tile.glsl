// The tile that a work group draws, of those that see something (tiles/list_tile.glsl). The kernel brings CORE_LISTED_BINDING.

layout(set = 0, binding = CORE_LISTED_BINDING, std430) readonly buffer core_listed_block { uint core_listed[]; };

// `first`: where in the list the dispatch begins; its groups are counted along the first axis.
uint core_listed_tile(uint first) { return core_listed[first + gl_WorkGroupID.x]; }
