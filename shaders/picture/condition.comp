// Whether a condition holds at the points of a surface that pixels show: where it does not, they are cut away.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/place_error.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 0) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 1, std430) buffer core_marks_block { core_mark core_marks[]; };
// Values of the condition's field at the same points.
layout(set = 0, binding = 2) CORE_READ_SAMPLES(core_values);
// What they are compared with, and their error.
layout(set = 0, binding = 3, std430) readonly buffer core_limit_block { elvis_real core_limit[2]; };
// Of these values; of points that had places the flags are the picture's already.
layout(set = 0, binding = 4) CORE_READ_MARKS(core_value_marks);
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    uint core_is_above;
    uint core_takes_equal;
};

bool core_has_value(uint pixel) {
    return core_marks[pixel].owner != 0u && CORE_SAMPLE_NUMBER(core_samples, pixel) != CORE_NO_NUMBER;
}

// How much the field changes from the pixel to its neighbours on the surface.
elvis_real core_change_around(uint pixel, elvis_real value) {
    const ivec2 place = ivec2(pixel % core_width, pixel / core_width), last = ivec2(core_width, core_n_pixels / core_width) - 1;
    elvis_real change = elvis_real(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 there = clamp(place + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5)), ivec2(0), last);
        const uint other = uint(there.y) * core_width + uint(there.x);
        change = core_has_value(other) ? max(change, abs(CORE_SAMPLE_VALUE(core_values, other) - value)) : change;
    }
    return change;
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel >= core_n_pixels || !core_has_value(pixel)) {
        return;
    }
    const elvis_real value = CORE_SAMPLE_VALUE(core_values, pixel);
    const elvis_real margin = core_is_above != 0u ? value - core_limit[0] : core_limit[0] - value;
    const bool holds = margin > elvis_real(0) || (core_takes_equal != 0u && margin == elvis_real(0));
    const bool is_undecided = abs(margin) <= core_limit[1] + CORE_PLACE_ERROR * core_change_around(pixel, value);
    // What is cut away in doubt may hide what is found behind it.
    const uint doubt = holds ? CORE_FLAG_UNDECIDED : CORE_FLAG_UNDECIDED_IN_FRONT;
    const uint flags =
        (holds ? 0u : CORE_FLAG_CUT) | (is_undecided ? doubt : 0u) | (CORE_MARK(core_value_marks, pixel).flags & CORE_FLAG_ESTIMATED);
    if (flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
}
