// Keeps what is seen of a transparent layer, for blending.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0) CORE_READ_SAMPLES(core_layer_samples);
layout(set = 0, binding = 1) CORE_READ_MARKS(core_layer_marks);
layout(set = 0, binding = 2) CORE_READ_ROWS(core_layer_colors);
layout(set = 0, binding = 3, std430) writeonly buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 4, std430) writeonly buffer core_depths_block { elvis_real core_depths[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels) {
        const elvis_vec4 color = CORE_ROW(core_layer_colors, pixel);
        const bool is_seen = CORE_MARK(core_layer_marks, pixel).owner != 0u && color.w > elvis_real(0);
        core_colors[pixel] = is_seen ? color : elvis_vec4(0);
        core_depths[pixel] = is_seen ? CORE_SAMPLE_DEPTH(core_layer_samples, pixel) : CORE_FAR;
    }
}
