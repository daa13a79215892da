// The value of a field at places in elements that are known, for the pixels that show some of one class.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"
#include "element/place.glsl"

layout(set = 0, binding = 0, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 1, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_places_block { core_place core_places[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_first;
    uint core_n_pixels;
    uint core_first_component;
    uint core_end_component;
};

#include "element/shape_region.glsl"
#include "field/shown_value.glsl"

void main() {
    const uint pixel = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = pixel < core_n_pixels;
    const uint safe_pixel = is_pixel ? pixel : 0u;
    const core_place place = core_places[safe_pixel];
    const bool is_shown = is_pixel && core_marks[safe_pixel].owner != 0u && core_class_of(place) == CORE_CLASS;
    const elvis_real value =
        core_shown_value(is_shown ? place.element : 0u, is_shown ? elvis_vec3(place.x, place.y, place.z) : CORE_CENTROID);
    if (is_shown) {
        core_samples[pixel].value = value;
        core_marks[pixel].flags |= CORE_VALUE_FLAGS;
    }
    const uint n_shown = subgroupAdd(is_shown ? 1u : 0u);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], n_shown);
    }
}
