// Empties the samples of a picture.

#include "library/samples.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) writeonly buffer core_samples_block { core_sample core_samples[]; };
layout(push_constant) uniform core_parameters { uint core_n_pixels; uint core_groups_x; };

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * 32u + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels) {
        core_samples[pixel] = core_no_sample();
    }
}
