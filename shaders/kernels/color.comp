// Colours of the samples: a table of (value, r, g, b), piecewise linear, with colours of its own below, above and for NaN.

#include "library/finite.glsl"
#include "library/samples.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
// Points of the table, then below, above, NaN and background.
layout(set = 0, binding = 1, std430) readonly buffer core_table_block { elvis_vec4 core_table[]; };
layout(set = 0, binding = 2, std430) writeonly buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 3, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_n_points;
    // Flags of every pixel that is hit.
    uint core_common_flags;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * 256u + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const uint owner = is_inside ? core_marks[pixel].owner : 0u;
    const bool is_drawn = owner != 0u;
    elvis_real value = elvis_real(0);
    for (uint turn = 0u; turn < (is_drawn ? 1u : 0u); ++turn) {
        value = core_samples[pixel].value;
    }
    const bool is_nan = !core_is_finite(value);

    // How many points are not above the value.
    uint low = 0u;
    uint high = is_drawn && !is_nan ? core_n_points : 0u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        const bool is_below = core_table[middle].x <= value;
        low = is_below ? middle + 1u : low;
        high = is_below ? high : middle;
    }
    const elvis_vec4 from = core_table[low > 0u ? low - 1u : 0u];
    const elvis_vec4 to = core_table[min(low, core_n_points - 1u)];
    const elvis_real extent = to.x - from.x;
    const elvis_real t = extent > elvis_real(0) ? (value - from.x) / extent : elvis_real(0);
    const bool is_below = low == 0u, is_above = low == core_n_points && value > from.x;
    const uint special = is_drawn ? (is_nan ? 2u : (is_below ? 0u : 1u)) : 3u;
    const bool is_special = !is_drawn || is_nan || is_below || is_above;
    const elvis_vec4 interpolated = elvis_vec4(from.yzw + t * (to.yzw - from.yzw), elvis_real(1));
    const elvis_vec4 color = is_special ? core_table[core_n_points + special] : interpolated;
    if (is_inside) {
        core_colors[pixel] = color;
    }

    // On a face that no other element shares the domain may end; on one that is shared the field may have two values.
    const bool is_on_face = (owner & CORE_OWNER_ON_FACE) != 0u;
    const bool is_undecided = is_on_face && ((owner & CORE_OWNER_SHARED) == 0u || (owner & CORE_OWNER_AMBIGUOUS) != 0u);
    const uint flags = core_common_flags | (is_nan ? CORE_FLAG_NAN : 0u) | (is_undecided ? CORE_FLAG_UNDECIDED : 0u);
    for (uint turn = 0u; turn < (is_drawn && flags != 0u ? 1u : 0u); ++turn) {
        core_marks[pixel].flags |= flags;
    }
}
