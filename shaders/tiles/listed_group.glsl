// The group of rays of a work group (tiles/ray_group.glsl), from a list. The kernel brings CORE_GROUPS_BINDING.

#include "arithmetic/read_only.glsl"
#include "tiles/ray_group.glsl"

layout(set = 0, binding = CORE_GROUPS_BINDING) CORE_READ_WORDS(core_groups);

// Column and row of the invocation's pixel; `first`: where in the list the dispatch begins. It may be beyond the picture.
uvec2 core_group_pixel(uint first, uint width) {
    return core_pixel_in_group(CORE_WORD(core_groups, first + gl_WorkGroupID.x), gl_LocalInvocationID.x, width);
}
