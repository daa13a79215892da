// Puts a transparent layer over the picture, where nothing opaque is in front of it.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0) CORE_READ_ROWS(core_layer_colors);
layout(set = 0, binding = 1) CORE_READ_REALS(core_layer_depths);
layout(set = 0, binding = 2, std430) buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 3) CORE_READ_REALS(core_depths);
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = min(pixel, core_n_pixels - 1u);
    const elvis_real depth = CORE_REAL(core_layer_depths, safe);
    if (pixel < core_n_pixels && depth < CORE_REAL(core_depths, safe)) {
        // Colours are not multiplied by opacity, so that an opaque background stays what it is.
        const elvis_vec4 over = CORE_ROW(core_layer_colors, pixel), under = core_colors[pixel];
        const elvis_real rest = under.w * (elvis_real(1) - over.w), alpha = over.w + rest;
        const elvis_real share = alpha > elvis_real(0) ? over.w / alpha : elvis_real(0);
        core_colors[pixel] = elvis_vec4(mix(under.xyz, over.xyz, share), alpha);
    }
}
