// For each pixel the next crossing of its ray with a surface: t, its error, the normal, the bending; and the box of all crossings
// of a tile of pixels, for cut_surface/surface_tiles.comp.
//
// The text of the kernel starts with surface/KIND.glsl, which gives core_next_hit. Crossings are looked for in a box only:
// that of the volume, outside of which nothing is to be seen.
//
// The first round looks from the eye on, or from core_beyond; every further one beyond the crossings of the round before that lie
// in no element.
//
// A work group is a tile of pixels, or CORE_HIT_ROWS rows of it, an invocation one of its columns.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/read_only.glsl"
#include "picture/view.glsl"
#include "surface/hit.glsl"
#include "surface/hit_record.glsl"
#include "picture/place_error.glsl"

layout(set = 0, binding = 2, std430) buffer core_hits_block { core_hit_record core_hits[]; };
// Three numbers a pixel: unit, towards the viewer.
layout(set = 0, binding = 3, std430) writeonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 4, std430) writeonly buffer core_bending_block { elvis_real core_bending[]; };
// Lower corner and negated upper corner of each work group's crossings, in the hierarchies' coordinates.
layout(set = 0, binding = 5, std430) writeonly buffer core_boxes_block { float core_boxes[]; };
layout(set = 0, binding = 6, std430) buffer core_marks_block { core_mark core_marks[]; };
// [0]: crossings found.
layout(set = 0, binding = 7, std430) buffer core_counts_block { uint core_counts[]; };
// A depth for each pixel, if core_has_beyond; infinite where nothing more is wanted.
layout(set = 0, binding = 8) CORE_READ_REALS(core_beyond);
// Surfaces whose parts have values of their own bring core_hit_value and core_hit_number, of the crossing found last: then it is all that
// is to be known of the pixel.
#ifdef CORE_HAS_OWN_VALUES
layout(set = 0, binding = 9, std430) writeonly buffer core_samples_block { core_sample core_samples[]; };
#endif
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_tile_row;
    // Counted from 1.
    uint core_surface_number;
    uint core_round;
    uint core_has_beyond;
    // What else of the surface a pixel may show is wanted: lines are looked for in whole pixels.
    uint core_with_whole_pixels;
};

shared float core_lane_boxes[6 * CORE_TILE_WIDTH];
// The least end of a box that holds nothing.
#define CORE_NOWHERE 3e38

#include "arithmetic/count.glsl"
#include "picture/distrust_column.glsl"

// The next pixel of a column that is still looking, from a row on.
uint core_next_row(uint column, uint row, uint end_row) {
    bool is_done = core_round > 0u || core_has_beyond != 0u;
    while (is_done && row < end_row) {
        const uint pixel = row * core_size.x + column;
        const bool is_found = core_marks[pixel].owner >> CORE_OWNER_BITS == core_surface_number;
        is_done = core_round > 0u ? core_hits[pixel].t >= CORE_FAR || is_found : CORE_REAL(core_beyond, pixel) >= CORE_FAR;
        if (is_done) {
            core_hits[pixel].t = CORE_FAR;
        }
        row += is_done ? 1u : 0u;
        if (!is_done || row >= end_row) {
            break;
        }
    }
    return row;
}

// Behind this parameter of the ray crossings count.
elvis_real core_after(uint pixel, elvis_real stretch, elvis_real reference_distance) {
    elvis_real after = core_near.x / stretch - reference_distance;
    if (core_round > 0u) {
        after = core_hits[pixel].t + elvis_real(2) * core_hits[pixel].error;
    }
    if (core_round == 0u && core_has_beyond != 0u) {
        // To depth and back: rounding of depth itself.
        const elvis_real beyond = CORE_REAL(core_beyond, pixel);
        after = (beyond + elvis_real(4) * CORE_ROUNDOFF * abs(beyond)) / stretch - reference_distance;
    }
    return after;
}

// The pixel's ray in the box, from a little before to a little behind; nothing of it if nothing is wanted there.
core_surface_ray core_surface_ray_of(core_cut_column along, elvis_real row, uint pixel) {
    const elvis_real down = row - along.row0;
    core_surface_ray ray;
    ray.origin = (along.base + down * along.base_row).xyz;
    ray.direction = (along.direction + down * along.direction_row).xyz;
    const elvis_real stretch = length(ray.direction);
    ray.after = core_after(pixel, stretch, along.reference_distance);
    ray.is_behind_crossing = core_round > 0u || core_has_beyond != 0u;
    ray.with_whole_pixel = core_with_whole_pixels != 0u;
    const elvis_real tiny = elvis_real(1e-30LF);
    const elvis_vec3 inverse = elvis_real(1) / mix(ray.direction, elvis_vec3(tiny), lessThan(abs(ray.direction), elvis_vec3(tiny)));
    const elvis_vec3 one = (core_shape[0].xyz - ray.origin) * inverse, other = (core_shape[1].xyz - ray.origin) * inverse;
    const elvis_vec3 near = min(one, other), far = max(one, other);
    const elvis_real enter = max(max(near.x, near.y), near.z), leave = min(min(far.x, far.y), far.z);
    const elvis_vec3 terms = (along.size + abs(down * along.base_row)).xyz;
    const elvis_real reach = max(abs(enter), abs(leave)) * max(max(abs(ray.direction.x), abs(ray.direction.y)), abs(ray.direction.z));
    ray.noise = elvis_real(4) * CORE_ROUNDOFF * (max(max(terms.x, terms.y), terms.z) + reach);
    const elvis_real margin = elvis_real(16) * CORE_ROUNDOFF * (abs(enter) + abs(leave)) + ray.noise;
    ray.from = max(enter - margin, elvis_real(0.5LF) * core_near.x / stretch - along.reference_distance);
    ray.to = leave + margin;
    ray.end_error = core_shape[1].w > elvis_real(0) ? elvis_real(2) * margin : -CORE_FAR;
    const bool is_wanted = ray.from < ray.to && ray.after < ray.to;
    ray.to = is_wanted ? ray.to : ray.from - elvis_real(1);
    return ray;
}

// Whether the point may be farther from the surface than clipping reckons with.
bool core_is_off_surface(core_surface_ray ray, core_hit hit, elvis_real along_ray) {
    const elvis_vec3 normal = elvis_vec3(hit.normal_x, hit.normal_y, hit.normal_z);
    const elvis_real stretch = length(ray.direction), size = length(normal);
    const elvis_real cosine = size > elvis_real(0) ? abs(dot(normal, ray.direction)) / (size * stretch) : elvis_real(1);
    return along_ray * cosine > CORE_HEIGHT_ERROR * (abs(hit.t) * stretch + length(ray.origin + hit.t * ray.direction));
}

// What unit normals may be off without a flag.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NORMAL_ERROR elvis_real(1e-9LF)
#else
#define CORE_NORMAL_ERROR elvis_real(1e-3LF)
#endif

// Whether the error of the point turns the normal farther: near the apex of a cone. Nothing is known where there is no bound.
bool core_is_turned(core_hit hit, elvis_real along_ray) {
    return hit.bending < CORE_FAR && along_ray * hit.bending > CORE_NORMAL_ERROR;
}

// Writes what the pixel's ray meets, if anything is wanted of it. `along_ray`: the error of the point.
void core_store_hit(uint pixel, core_surface_ray ray, core_hit hit, bool is_wanted, elvis_real along_ray) {
    const bool is_hit = hit.is_hit && is_wanted;
    core_hits[pixel].t = is_hit ? hit.t : CORE_FAR;
    // Where the ray runs along the surface, the point's error outgrows what pictures may show.
    const bool is_vague = is_hit && (along_ray > core_shape[0].w || core_is_turned(hit, along_ray));
    const uint flags = (is_wanted && hit.is_undecided ? CORE_FLAG_UNDECIDED_IN_FRONT : is_vague ? CORE_FLAG_UNDECIDED : 0u) |
                       (is_wanted && hit.is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u) |
                       (is_wanted && hit.is_estimated ? CORE_FLAG_ESTIMATED : 0u) |
                       (is_hit && core_is_off_surface(ray, hit, along_ray) ? CORE_FLAG_VAGUE : 0u);
    if (flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    if (is_hit) {
        core_hits[pixel].error = hit.error;
        const elvis_vec3 normal = elvis_vec3(hit.normal_x, hit.normal_y, hit.normal_z);
        const elvis_real size = (dot(normal, ray.direction) > elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / length(normal);
        core_normals[3u * pixel] = size * normal.x;
        core_normals[3u * pixel + 1u] = size * normal.y;
        core_normals[3u * pixel + 2u] = size * normal.z;
        core_bending[pixel] = hit.bending;
    }
}

// A box, in the hierarchies' coordinates, in scalars because it grows round a loop. Upper ends are negated: all six are least ones.
struct core_hit_box {
    float low_x, low_y, low_z, minus_high_x, minus_high_y, minus_high_z;
};

void core_add_to_box(bool is_hit, core_surface_ray ray, elvis_real t, elvis_real along_ray, inout core_hit_box box) {
    const vec3 place = vec3(ray.origin + t * ray.direction + core_reference_in_hierarchy.xyz);
    const vec3 shift = abs(vec3(core_reference_in_hierarchy.xyz));
    const float size = max(max(shift.x, shift.y), shift.z) + max(max(abs(place.x), abs(place.y)), abs(place.z));
    const elvis_real error = elvis_real(4) * ray.noise + elvis_real(2) * min(along_ray, core_shape[0].w);
    const float width = float(error) + 8.0 * CORE_FLOAT_ROUNDOFF * size;
    box.low_x = is_hit ? min(box.low_x, place.x - width) : box.low_x;
    box.low_y = is_hit ? min(box.low_y, place.y - width) : box.low_y;
    box.low_z = is_hit ? min(box.low_z, place.z - width) : box.low_z;
    box.minus_high_x = is_hit ? min(box.minus_high_x, -(place.x + width)) : box.minus_high_x;
    box.minus_high_y = is_hit ? min(box.minus_high_y, -(place.y + width)) : box.minus_high_y;
    box.minus_high_z = is_hit ? min(box.minus_high_z, -(place.z + width)) : box.minus_high_z;
}

// The box of all columns: six lanes, one for each end. `group`: in core_boxes. All of the group's invocations come here.
void core_store_box(core_hit_box box, uint group) {
    const uint lane = gl_LocalInvocationID.x;
    core_lane_boxes[lane] = box.low_x;
    core_lane_boxes[CORE_TILE_WIDTH + lane] = box.low_y;
    core_lane_boxes[2u * CORE_TILE_WIDTH + lane] = box.low_z;
    core_lane_boxes[3u * CORE_TILE_WIDTH + lane] = box.minus_high_x;
    core_lane_boxes[4u * CORE_TILE_WIDTH + lane] = box.minus_high_y;
    core_lane_boxes[5u * CORE_TILE_WIDTH + lane] = box.minus_high_z;
    barrier();
    if (lane < 6u) {
        float least = CORE_NOWHERE;
        for (uint i = 0u; i < CORE_TILE_WIDTH; ++i) {
            least = min(least, core_lane_boxes[lane * CORE_TILE_WIDTH + i]);
        }
        core_boxes[6u * group + lane] = least;
    }
}

void main() {
    const uint column = gl_WorkGroupID.x * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint rows_of_groups = core_first_tile_row * (CORE_TILE_HEIGHT / CORE_HIT_ROWS) + gl_WorkGroupID.y;
    const uint first_row = rows_of_groups * CORE_HIT_ROWS;
    const uint end_row = column < core_size.x ? min(first_row + CORE_HIT_ROWS, core_size.y) : first_row;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    core_hit_box box = core_hit_box(CORE_NOWHERE, CORE_NOWHERE, CORE_NOWHERE, CORE_NOWHERE, CORE_NOWHERE, CORE_NOWHERE);
    uint n_found = 0u;
    uint row = core_next_row(column, first_row, end_row);
    while (row < end_row) {
        const uint pixel = row * core_size.x + column;
        const core_surface_ray ray = core_surface_ray_of(along, elvis_real(row), pixel);
        const core_hit hit = core_next_hit(ray);
        const bool is_wanted = ray.from < ray.to, is_hit = hit.is_hit && is_wanted;
        const elvis_real stretch = length(ray.direction), along_ray = hit.error * stretch;
        core_store_hit(pixel, ray, hit, is_wanted, along_ray);
#ifdef CORE_HAS_OWN_VALUES
        if (is_hit) {
            core_samples[pixel] = core_sample(core_hit_value(), (hit.t + along.reference_distance) * stretch, core_hit_number());
            core_marks[pixel].owner = core_surface_number << CORE_OWNER_BITS;
        }
#endif
        core_add_to_box(is_hit, ray, hit.t, along_ray, box);
        n_found += is_hit ? 1u : 0u;
        row = core_next_row(column, row + 1u, end_row);
        if (row >= end_row) {
            break;
        }
    }
    core_distrust_column(column, first_row, row, end_row, core_surface_number >> 31);
    const uint groups_a_row = (core_size.x + CORE_TILE_WIDTH - 1u) / CORE_TILE_WIDTH;
    core_store_box(box, rows_of_groups * groups_a_row + gl_WorkGroupID.x);
    if (end_row > first_row) {
        core_count(0u, n_found);
    }
}
