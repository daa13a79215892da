// Colours as screens show them: the nearest of 256 levels, over grey where the picture is not opaque.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "arithmetic/read_only.glsl"

layout(set = 0, binding = 0) CORE_READ_ROWS(core_colors);
// The least number of level 1, of level 2, and so on; the last one is beyond 1.
layout(set = 0, binding = 1) CORE_READ_REALS(core_least);
layout(set = 0, binding = 2, std430) writeonly buffer core_pixels_block { uint core_pixels[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    float core_grey;
};

elvis_real core_clamped(elvis_real channel) { return channel > elvis_real(0) ? min(channel, elvis_real(1)) : elvis_real(0); }

// Rounded downwards first; a product that rounding takes to the next whole number is nearest to that one.
uint core_level(elvis_real channel) {
    const uint level = uint(elvis_real(255) * channel);
    return channel >= CORE_REAL(core_least, level) ? level + 1u : level;
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels) {
        const elvis_vec4 color = CORE_ROW(core_colors, pixel);
        const elvis_real alpha = core_clamped(color.w), behind = (elvis_real(1) - alpha) * elvis_real(core_grey);
        uint rgba = 0xff000000u;
        for (int channel = 0; channel < 3; ++channel) {
            const elvis_real shown = core_clamped(color[channel]);
            rgba |= core_level(alpha < elvis_real(1) ? alpha * shown + behind : shown) << (8 * channel);
        }
        core_pixels[pixel] = rgba;
    }
}
