// Whether the rays of a tile can meet an isovalue in an octant; for tiles/ray_tiles.comp.

#include "arithmetic/read_only.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 3) CORE_READ_REALS(core_isovalues);

#include "isosurface/isovalues.glsl"
#include "isosurface/octant_frustum.glsl"

bool core_leaf_is_met(uint item, core_frustum frustum, vec2 span) {
    core_begin_isovalues();
    return core_frustum_meets_isovalue(core_fetch_octant(item), frustum, span);
}
