// Puts what rays have gathered in front of the picture.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_states_block { core_volume_state core_states[]; };
layout(set = 0, binding = 1, std430) buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
// Pixels that the volume colours.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    float core_tolerance;
    // What colours are off because they have few breakpoints.
    float core_color_error;
};

#include "arithmetic/count.glsl"

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const core_volume_state state = core_states[min(pixel, core_n_pixels - 1u)];
    const core_light light = state.light;
    const bool is_drawn = is_inside && light.transmittance < elvis_real(1);
    // Or no number.
    const uint inexact = core_light_error(light) <= elvis_real(core_tolerance) ? 0u : CORE_FLAG_VOLUME_TOLERANCE;
    const uint cut_short = state.walk.status == CORE_RAY_ENDS ? 0u : CORE_FLAG_WORK_LIMIT;
    if (is_drawn) {
        // Colours are not multiplied by opacity, so that an opaque background stays what it is; light is.
        const elvis_vec4 under = core_colors[pixel];
        const elvis_real rest = under.w * light.transmittance, alpha = elvis_real(1) - light.transmittance + rest;
        const elvis_vec3 all = elvis_vec3(light.red, light.green, light.blue) + rest * under.xyz;
        core_colors[pixel] = elvis_vec4(alpha > elvis_real(0) ? all / alpha : under.xyz, alpha);
    }
    if (is_inside) {
        core_marks[pixel].flags |= state.walk.flags | cut_short | inexact;
    }
    core_count(0u, is_drawn ? 1u : 0u);
}
