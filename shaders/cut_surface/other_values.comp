// Whether it matters which of the elements that hold a point is shown: compares the value in another one with the pixel's.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 0) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 1, std430) buffer core_marks_block { core_mark core_marks[]; };
#define CORE_OTHERS_BINDING 2
#include "cut_surface/other_elements.glsl"
layout(push_constant) uniform core_parameters {
    uint core_first;
    uint core_first_component;
    uint core_end_component;
    // Of values: what makes no difference to the picture.
    float core_value_tolerance;
};

#include "element/shape_region.glsl"
#include "field/shown_value.glsl"

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_listed = i < core_n_others;
    const core_other_element other = core_others[is_listed ? i : 0u];
    const elvis_real value =
        core_shown_value(is_listed ? other.element : 0u, is_listed ? elvis_vec3(other.x, other.y, other.z) : CORE_CENTROID);
    // Of no number it cannot be said that it makes no difference.
    if (is_listed && !(abs(value - CORE_SAMPLE_VALUE(core_samples, other.pixel)) <= elvis_real(core_value_tolerance))) {
        core_marks[other.pixel].owner |= CORE_OWNER_AMBIGUOUS;
    }
}
