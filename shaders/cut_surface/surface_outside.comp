// Crossings with a surface that lie in no element: shown as such, for a colour of their own (picture/color.comp). A plane (CORE_ON_PLANE)
// has no end: it is shown in a box around the volume. Where rounding decides whether the point lies in it, the pixel is undecided.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/finite.glsl"
#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 1, std430) writeonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
#if !CORE_ON_PLANE
#include "surface/hit_record.glsl"
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
    const vec3 in_box = min(place - vec3(core_lower_x, core_lower_y, core_lower_z), vec3(core_upper_x, core_upper_y, core_upper_z) - place);
    const float depth_in_box = min(min(in_box.x, in_box.y), in_box.z);
    const elvis_real t = point.is_hit && depth_in_box >= 0.0 ? point.t : CORE_FAR;
    // The point's error, the rounding of point and box to single precision, and that of the world's box in double precision.
    const vec3 sizes = 4.0 * CORE_FLOAT_ROUNDOFF * abs(place) + 1e-15 * abs(vec3(core_reference.xyz));
    const float rounding = float(point.error) + max(max(sizes.x, sizes.y), sizes.z);
    const bool is_at_end = point.is_hit && abs(depth_in_box) <= rounding;
#else
    const elvis_real t = core_hits[safe].t;
    // surface/hits.comp has looked at it.
    const bool is_at_end = false;
#endif
    const bool is_elsewhere = pixel < core_n_pixels && core_marks[safe].owner >> CORE_OWNER_BITS != core_surface_number;
    const bool is_outside = is_elsewhere && t < CORE_FAR;
    if (is_elsewhere && is_at_end) {
        core_marks[pixel].flags |= CORE_FLAG_UNDECIDED_IN_FRONT;
    }
    if (is_outside) {
        const elvis_vec3 direction = (column.direction + (row - column.row0) * column.direction_row).xyz;
        core_samples[pixel].value = core_nan();
        core_samples[pixel].depth = (t + column.reference_distance) * length(direction);
        core_samples[pixel].number = CORE_NO_NUMBER;
        core_marks[pixel].owner = core_surface_number << CORE_OWNER_BITS;
    }
}
