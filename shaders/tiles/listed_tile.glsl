// The tile that a work group draws, of those that see something (tiles/list_tile.glsl). The kernel brings CORE_LISTED_BINDING.

#include "arithmetic/read_only.glsl"

layout(set = 0, binding = CORE_LISTED_BINDING) CORE_READ_WORDS(core_listed);

// `first`: where in the list the dispatch begins; its groups are counted along the first axis.
uint core_listed_tile(uint first) { return CORE_WORD(core_listed, first + gl_WorkGroupID.x); }
