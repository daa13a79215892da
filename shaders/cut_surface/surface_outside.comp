// Crossings with a surface that lie in no element: shown as such, for a colour of their own (picture/color.comp). A plane (CORE_ON_PLANE)
// has no end: it is shown in a box around the volume.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/finite.glsl"
#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 1, std430) writeonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
#if !CORE_ON_PLANE
#include "cut_surface/hit_record.glsl"
layout(set = 0, binding = 3, std430) readonly buffer core_hits_block { core_hit_record core_hits[]; };
#endif
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    uint core_surface_number;
    // Of planes: the box, relative to the reference point.
    float core_lower_x, core_lower_y, core_lower_z;
    float core_upper_x, core_upper_y, core_upper_z;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = pixel < core_n_pixels ? pixel : 0u;
    const core_cut_column column = core_cut_begin(elvis_real(safe % core_width));
    const elvis_real row = elvis_real(safe / core_width);
#if CORE_ON_PLANE
    const core_cut_point point = core_cut_pixel(column, row);
    const vec3 place = vec3(point.position);
    const bool is_in_box = all(greaterThanEqual(place, vec3(core_lower_x, core_lower_y, core_lower_z))) &&
                           all(lessThanEqual(place, vec3(core_upper_x, core_upper_y, core_upper_z)));
    const elvis_real t = point.is_hit && is_in_box ? point.t : CORE_FAR;
#else
    const elvis_real t = core_hits[safe].t;
#endif
    const bool is_outside = pixel < core_n_pixels && t < CORE_FAR && core_marks[safe].owner >> CORE_OWNER_BITS != core_surface_number;
    if (is_outside) {
        const elvis_vec3 direction = (column.direction + (row - column.row0) * column.direction_row).xyz;
        core_samples[pixel].value = core_nan();
        core_samples[pixel].depth = (t + column.reference_distance) * length(direction);
        core_samples[pixel].number = CORE_NO_NUMBER;
        core_marks[pixel].owner = core_surface_number << CORE_OWNER_BITS;
    }
}
