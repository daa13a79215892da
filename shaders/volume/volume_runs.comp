// Takes from rays the light of the run that lies behind them: as soon as the next walk (segments/walk_state.glsl) is found, where they wait
// at a stop, and at the end of all. A part of a volume gives its light in such runs. What lies between them is put there by the host.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "picture/samples.glsl"
#include "volume/volume_state.glsl"

// As the host reads it: core/render/volume/light_runs.cpp.
struct core_run {
    uint pixel;
    // CORE_FLAG_...: of the whole ray, with its last run.
    uint flags;
    // Depths between which it lies.
    elvis_real first, end;
    elvis_real red, green, blue, transmittance;
    elvis_real error, rounding;
};

layout(set = 0, binding = 1, std430) buffer core_states_block { core_volume_state core_states[]; };
// Where the run began, as a parameter of the ray; far behind the eye where that is at the eye.
layout(set = 0, binding = 2, std430) buffer core_firsts_block { elvis_real core_firsts[]; };
layout(set = 0, binding = 3, std430) writeonly buffer core_runs_block { core_run core_runs[]; };
layout(set = 0, binding = 4, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    // As the host has it: LightRuns::When.
    uint core_when;
};

#define CORE_AT_STOP 1u
#define CORE_AT_END 2u

// Along the pixel's ray.
elvis_real core_depth_at(uint pixel, elvis_real t) {
    const core_cut_column column = core_cut_begin(elvis_real(pixel % core_width));
    const elvis_real down = elvis_real(pixel / core_width) - column.row0;
    return (t + column.reference_distance) * length((column.direction + down * column.direction_row).xyz);
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const uint safe = min(pixel, core_n_pixels - 1u);
    core_volume_state state = core_states[safe];
    // All rays wait, or go no farther: what they have left is a run.
    const bool is_stop = core_when == CORE_AT_STOP, is_end = core_when == CORE_AT_END;
    const bool is_found = state.walk.status == CORE_RAY_HAS_SOUGHT && state.walk.global_element != CORE_NO_ELEMENT;
    const bool begins = is_inside && !is_stop && !is_end && is_found;
    const uint cut_short = state.walk.status == CORE_RAY_ENDS ? 0u : CORE_FLAG_WORK_LIMIT;
    const uint flags = is_end ? state.walk.flags | cut_short : 0u;
    const bool is_taken = is_inside && (begins || is_stop || is_end) && (state.light.transmittance < elvis_real(1) || flags != 0u);
    if (is_taken) {
        const uint place = atomicAdd(core_counts[0], 1u);
        const core_light light = state.light;
        const elvis_real first = max(core_depth_at(pixel, core_firsts[pixel]), elvis_real(0));
        core_runs[place] = core_run(pixel, flags, first, core_depth_at(pixel, state.walk.done), light.red,
                                    light.green, light.blue, light.transmittance, light.error, light.rounding);
        const elvis_real none = elvis_real(0);
        core_states[pixel].light = core_light(none, none, none, elvis_real(1), none, none);
    }
    if (begins && (is_taken || state.light.transmittance == elvis_real(1))) {
        core_firsts[pixel] = max(state.walk.at, state.walk.done);
    }
    if (is_inside && is_stop && state.walk.status == CORE_RAY_WAITS) {
        core_firsts[pixel] = max(core_firsts[pixel], state.walk.done);
        core_states[pixel].walk.status = CORE_RAY_GOES;
    }
}
