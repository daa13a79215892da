// Rays go through a transparent surface, as far as they have got, and go on behind it.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 0, std430) buffer core_states_block { core_volume_state core_states[]; };
layout(set = 0, binding = 1) CORE_READ_ROWS(core_layer_colors);
layout(set = 0, binding = 2) CORE_READ_REALS(core_layer_depths);
// Of the nearest opaque surface.
layout(set = 0, binding = 3) CORE_READ_REALS(core_depths);
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    float core_tolerance;
    // What colours are off because they have few breakpoints.
    float core_color_error;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = min(pixel, core_n_pixels - 1u);
    const bool is_seen = pixel < core_n_pixels && CORE_REAL(core_layer_depths, safe) < CORE_REAL(core_depths, safe);
    if (is_seen) {
        core_volume_state state = core_states[pixel];
        const elvis_vec4 color = CORE_ROW(core_layer_colors, pixel);
        core_add_light(state.light, color.w * color.xyz, elvis_real(1) - color.w);
        state.walk.status = state.walk.status == CORE_RAY_WAITS ? CORE_RAY_GOES : state.walk.status;
        core_states[pixel] = state;
    }
}
