// What opaque surfaces, drawn before, hide of the layer of the next one.
//
// Before it is drawn they stand in the layer as a surface that nothing behind goes before (picture/show.glsl): then nothing is
// evaluated there, and isosurfaces are not looked for. Afterwards what still stands there is taken away again.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) buffer core_layer_samples_block { core_sample core_layer_samples[]; };
layout(set = 0, binding = 1, std430) buffer core_layer_marks_block { core_mark core_layer_marks[]; };
// Depth of the nearest opaque surface; CORE_FAR where there is none.
layout(set = 0, binding = 2) CORE_READ_REALS(core_depths);
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    // 0: put the opaque surfaces there; 1: take them away; 2: take away what they hide.
    uint core_step;
};

// No surface has this number.
#define CORE_OCCLUDER (0x3ffffffu << CORE_OWNER_BITS)

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const uint safe = is_inside ? pixel : 0u;
    const elvis_real depth = CORE_REAL(core_depths, safe);
    const uint owner = core_layer_marks[safe].owner;
    const bool is_put = core_step == 0u && is_inside && depth < CORE_FAR;
    if (is_put) {
        core_layer_samples[pixel].depth = depth;
        core_layer_samples[pixel].number = CORE_NO_NUMBER;
        core_layer_marks[pixel].owner = CORE_OCCLUDER;
    }
    const bool is_left = core_step == 1u && is_inside && (owner | ((1u << CORE_OWNER_BITS) - 1u)) == 0xffffffffu;
    if (is_left) {
        core_layer_marks[pixel].owner = 0u;
    }
    const bool is_drawn = core_step == 2u && is_inside && owner != 0u;
    const bool is_hidden = is_drawn && core_layer_samples[safe].depth >= depth;
    if (is_drawn) {
        core_layer_marks[pixel].owner = is_hidden ? 0u : owner;
        core_layer_marks[pixel].flags = core_layer_marks[pixel].flags & (is_hidden ? CORE_FLAGS_STAY | 0xffff0000u : 0xffffffffu);
    }
    const uint n_taken = subgroupAdd(is_left || is_hidden ? 1u : 0u);
    if (subgroupElect() && n_taken > 0u) {
        atomicAdd(core_counts[0], n_taken);
    }
}
