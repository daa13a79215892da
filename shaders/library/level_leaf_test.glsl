// Whether the rays of a tile can meet an isovalue in a cell; for kernels/ray_tiles.comp.

#include "library/samples.glsl"

layout(std430, set = 0, binding = 3) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };

#include "library/isovalues.glsl"
#include "library/level_beam.glsl"

bool core_leaf_is_met(uint item, core_beam beam, vec2 span) {
    core_begin_isovalues();
    return core_beam_meets_level(core_fetch_level_cell(item), beam, span);
}
