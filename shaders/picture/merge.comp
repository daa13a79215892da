// Merges the layer of a surface into the picture. Samples and marks are those of the nearest surface, transparent ones included;
// colours those of the nearest opaque one. Transparent layers are kept apart until all surfaces are drawn (order_layers.comp,
// blend.comp).

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0) CORE_READ_SAMPLES(core_layer_samples);
layout(set = 0, binding = 1) CORE_READ_MARKS(core_layer_marks);
layout(set = 0, binding = 2) CORE_READ_REALS(core_layer_normals);
layout(set = 0, binding = 3) CORE_READ_ROWS(core_layer_colors);
layout(set = 0, binding = 4, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 5, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 6, std430) writeonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 7, std430) writeonly buffer core_colors_block { elvis_vec4 core_colors[]; };
// Depth of the nearest opaque surface; CORE_FAR where there is none.
layout(set = 0, binding = 8, std430) buffer core_depths_block { elvis_real core_depths[]; };
// What is left to be seen of this surface: the depth behind which its next crossing is wanted; CORE_FAR if none is.
layout(set = 0, binding = 9, std430) writeonly buffer core_beyond_block { elvis_real core_beyond[]; };
// How many pixels want one, and between which rows these are: the first, and one more than the last.
layout(set = 0, binding = 10, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 11, std430) readonly buffer core_background_block { elvis_vec4 core_background; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    // Counted from 1.
    uint core_surface_number;
    // The layer has normals.
    uint core_has_normals;
    // The picture is empty.
    uint core_is_first;
    uint core_width;
};

// The picture's flags with those of a pixel of the layer. Where a surface found nothing, or what it found is hidden or cut away, some
// stay; of what is seen through something transparent, doubt does, too.
uint core_merged_flags(core_mark layer, uint old_flags, bool is_drawn, bool is_nearest, bool is_seen_through) {
    const uint front_flags = is_nearest ? layer.flags : old_flags, back_flags = is_nearest ? old_flags : layer.flags;
    const uint doubt = is_seen_through ? core_doubt_behind(back_flags & 0xffffu) : 0u;
    const uint staying = (back_flags & (is_drawn ? CORE_FLAGS_STAY : 0xffffu)) | doubt;
    return front_flags | (back_flags & 0xffff0000u) | CORE_STAYING(staying);
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const uint safe = is_inside ? pixel : 0u;
    const core_mark layer = CORE_MARK(core_layer_marks, safe);
    const bool is_drawn = is_inside && layer.owner != 0u;
    elvis_real depth = CORE_FAR;
    elvis_vec4 color = elvis_vec4(0);
    if (is_drawn) {
        depth = CORE_SAMPLE_DEPTH(core_layer_samples, pixel);
        color = CORE_ROW(core_layer_colors, pixel);
    }
    const bool is_seen = color.w > elvis_real(0);
    const bool is_opaque = color.w >= elvis_real(1);

    const bool is_first = core_is_first != 0u;
    const core_mark old = core_marks[safe];
    const bool is_empty = is_first || old.owner == 0u;
    elvis_real old_depth = CORE_FAR;
    if (!(is_empty || !is_inside)) {
        old_depth = core_samples[pixel].depth;
    }
    const bool is_nearest = is_seen && depth < old_depth;
    if (is_nearest) {
        core_samples[pixel] = CORE_SAMPLE(core_layer_samples, pixel);
    }
    if (is_nearest && core_has_normals != 0u) {
        core_normals[3u * pixel] = CORE_REAL(core_layer_normals, 3u * pixel);
        core_normals[3u * pixel + 1u] = CORE_REAL(core_layer_normals, 3u * pixel + 1u);
        core_normals[3u * pixel + 2u] = CORE_REAL(core_layer_normals, 3u * pixel + 2u);
    }
    const elvis_real opaque_depth = is_first ? CORE_FAR : core_depths[safe];
    // Through this layer, or this layer through another one.
    const bool is_seen_through = is_seen && (is_nearest ? !is_opaque && !is_empty : depth < opaque_depth);
    if (is_inside) {
        const uint low_bits = layer.owner & ((1u << CORE_OWNER_BITS) - 1u);
        core_marks[pixel].owner = is_nearest ? (core_surface_number << CORE_OWNER_BITS) | low_bits : (is_empty ? 0u : old.owner);
        core_marks[pixel].flags = core_merged_flags(layer, is_first ? 0u : old.flags, is_drawn, is_nearest, is_seen_through);
    }
    const bool is_in_front = is_opaque && depth < opaque_depth;
    if (is_inside && (is_first || is_in_front)) {
        core_colors[pixel] = is_in_front ? color : core_background;
        core_depths[pixel] = is_in_front ? depth : CORE_FAR;
    }
    const bool is_wanted = is_drawn && !is_opaque && depth < opaque_depth;
    if (is_inside) {
        core_beyond[pixel] = is_wanted ? depth : CORE_FAR;
    }
    const uint n_wanted = subgroupAdd(is_wanted ? 1u : 0u);
    const uint row = safe / core_width;
    const uint first_row = subgroupMin(is_wanted ? row : 0xffffffffu), end_row = subgroupMax(is_wanted ? row + 1u : 0u);
    if (subgroupElect() && n_wanted > 0u) {
        atomicAdd(core_counts[0], n_wanted);
        atomicMin(core_counts[1], first_row);
        atomicMax(core_counts[2], end_row);
    }
}
