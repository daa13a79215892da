// Whether the rays of a tile can meet an isovalue in a cell; for tiles/ray_tiles.comp.

#include "picture/samples.glsl"

layout(std430, set = 0, binding = 3) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };

#include "isosurface/isovalues.glsl"
#include "isosurface/octant_frustum.glsl"

bool core_leaf_is_met(uint item, core_beam beam, vec2 span) {
    core_begin_isovalues();
    return core_beam_meets_level(core_fetch_level_cell(item), beam, span);
}
