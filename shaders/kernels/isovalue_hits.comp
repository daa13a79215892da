// Which of several isovalues the pixels of a layer show.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "library/samples.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 1, std430) readonly buffer core_marks_block { core_mark core_marks[]; };
// Ascending, as they are in the samples.
layout(set = 0, binding = 2, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
// 1 where a pixel has that value.
layout(set = 0, binding = 3, std430) buffer core_hits_block { uint core_hits[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_n_isovalues;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_drawn = pixel < core_n_pixels && core_marks[min(pixel, core_n_pixels - 1u)].owner != 0u;
    const elvis_real value = is_drawn ? core_samples[pixel].value : elvis_real(0);
    // How many isovalues are below.
    uint low = 0u, high = is_drawn ? core_n_isovalues : 0u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        const bool is_below = core_isovalues[middle] < value;
        low = is_below ? middle + 1u : low;
        high = is_below ? high : middle;
    }
    const uint above = min(low, core_n_isovalues - 1u), below = above > 0u ? above - 1u : 0u;
    const uint nearest = value - core_isovalues[below] < core_isovalues[above] - value ? below : above;
    if (is_drawn && core_hits[nearest] == 0u) {
        core_hits[nearest] = 1u;
    }
}
