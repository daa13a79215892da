// Faces of the elements of one class, or two-dimensional elements, seen along the rays of a picture: the nearest crossing, and the
// field there.
//
// A face is a map of (u, v), both from -1 to 1, with u + v <= 0 in a triangle. A ray o + t d meets it where x(u, v) = o + t d.
// Each of its patches has a linear model and bounds of the rest (boundary/face_patch.glsl). Before anything is evaluated they show that a
// ray misses most patches; they give Newton's method its start; and they tell where a ray crosses a patch at most once. Pixels whose
// rays meet a patch for which that is not certain, near silhouettes, are left to boundary/faces_careful.comp.
//
// A work group is a tile of pixels, an invocation one of its columns. The tile's list (tiles/ray_tiles.comp) is in the order of
// depth, so that the search ends at the first patch behind the crossing found. The next pixel of a column starts where this one's
// crossing moves to. Tiles whose lists hold inner nodes of the hierarchy are drawn by a second version (CORE_DESCENDS).
//
// One evaluation of a face an iteration, whatever patch a lane is at, so that lanes do not wait for each other.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "element/face_frame.glsl"
#include "boundary/face_patch.glsl"
#include "boundary/face_point.glsl"
#include "tiles/ray_tiles.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "picture/pixel_ray.glsl"
#include "element/inside.glsl"
#include "boundary/face_rays.glsl"
#include "boundary/face_surface.glsl"
#include "boundary/face_descent.glsl"
#include "picture/distrust_column.glsl"
#define CORE_LISTED_BINDING 9
#include "tiles/listed_tile.glsl"

#define CORE_STEPS 8u
// Iterations and patches of one pixel: a tile's pixels together stay below where drivers end loops.
#define CORE_WORK_LIMIT 1500u

struct core_face_search {
    // The patch at hand, or CORE_NO_PATCH, its face, and the word of its square.
    uint patch_index, face, square_word;
    // Bounds of the patch for this ray (core_patch_meeting).
    float slope, bend;
    // Where Newton's method is, and its steps so far.
    elvis_real u, v;
    uint steps;
    // The patch that held the crossing of the column's last pixel comes first.
    bool is_tracking;
    // The pixel is left to boundary/faces_careful.comp.
    bool is_careful;
    // A crossing too near to the eye, or not.
    bool is_doubtful;
    uint n_steps, work;
};

core_face_search core_face_search_begin(bool is_tracking) {
    const elvis_real zero = elvis_real(0);
    return core_face_search(CORE_NO_PATCH, 0u, 0u, 0.0, 0.0, zero, zero, 0u, is_tracking, false, false, 0u, 0u);
}

bool core_goes_on(core_face_search search, core_face_descent descent) {
    return search.patch_index != CORE_NO_PATCH || search.is_tracking || core_has_more(descent);
}

// To the next patch if the ray can meet it. `track`: the crossing of the column's last pixel.
void core_next_patch(core_ray ray, core_face_crossing track, float end_t, inout core_face_search search, inout core_face_descent descent) {
    const bool is_from_track = search.is_tracking;
    const uint next = core_next_word(!is_from_track, end_t, descent);
    const uint word = is_from_track ? track.patch_index : next;
    const bool is_again = !is_from_track && word == track.patch_index;
    const bool is_tried = (word & CORE_TILE_INNER) == 0u && !is_again;
    search.is_tracking = false;
    // Without a guard, which would cost more than it saves: few iterations come without a patch.
    const uint tried = is_tried ? word : 0u;
    const core_patch_meeting meeting =
        core_meet_patch(tried, ray.box_origin, vec3(ray.direction), ray.far, float(ray.least_t), end_t);
    const bool is_met = is_tried && meeting.is_met;
    search.is_careful = search.is_careful || (is_met && !meeting.is_single);
    search.patch_index = is_met && meeting.is_single ? word : CORE_NO_PATCH;
    const uvec4 more = elvis_fetch4_core_patches(tried, 4u);
    search.square_word = more.w;
    search.face = more.z;
    const core_square square = core_square_of(more.w);
    const elvis_real size = elvis_real(square.size);
    search.u = is_from_track ? track.next_u : elvis_real(square.a) + size * elvis_real(clamp(meeting.a, -1.0, 1.0));
    search.v = is_from_track ? track.next_v : elvis_real(square.b) + size * elvis_real(clamp(meeting.b, -1.0, 1.0));
    search.slope = meeting.slope;
    search.bend = meeting.bend;
    search.steps = 0u;
    core_descend(word, ray, end_t, true, descent);
    core_end_if(search.is_careful, descent);
}

// A step of Newton's method on the patch.
void core_step_on_patch(core_ray ray, core_cut_column along, inout core_face_search search, inout core_face_descent descent,
                        inout core_face_crossing nearest) {
    const bool is_active = search.patch_index != CORE_NO_PATCH;
    const core_face_newton_step s = core_face_newton(search.face, search.u, search.v, ray);
    const core_square square = core_square_of(search.square_word);
    const elvis_real half_size = elvis_real(square.size), per_size = elvis_real(1) / half_size;
    const elvis_real middle_u = elvis_real(square.a), middle_v = elvis_real(square.b);
    const elvis_real u = search.u + s.step_u, v = search.v + s.step_v;
    const elvis_real step_length = max(abs(s.step_u), abs(s.step_v));
    const elvis_real left = half_size * core_patch_prediction_error(search.slope, search.bend, step_length * per_size);
    const elvis_real outside = half_size * core_patch_excess((u - middle_u) * per_size, (v - middle_v) * per_size, square.is_diagonal);
    const core_face_verdict verdict = core_judge_face_step(ray, s, u, v, outside, left);
    search.steps += is_active ? 1u : 0u;
    search.n_steps += is_active ? 1u : 0u;
    const bool is_done = verdict.has_converged || verdict.has_missed;
    search.is_careful = search.is_careful || (is_active && !is_done && search.steps == CORE_STEPS);
    search.is_doubtful = search.is_doubtful || (is_active && verdict.is_doubtful);
    const elvis_vec3 motion = along.base_row.xyz + s.t * along.direction_row.xyz;
    core_take_crossing(is_active && verdict.is_hit,
                       core_face_crossing_at(search.face, search.patch_index, search.square_word, u, v, s, motion), nearest);
    search.patch_index = is_done || search.is_careful ? CORE_NO_PATCH : search.patch_index;
    core_end_if(search.is_careful, descent);
    // Points are kept where the bounds hold.
    const elvis_real reach = elvis_real(CORE_PATCH_REACH) * half_size;
    search.u = clamp(u, middle_u - reach, middle_u + reach);
    search.v = clamp(v, middle_v - reach, middle_v + reach);
}

void main() {
    const uint tile = core_listed_tile(core_first);
    const uint column = tile % core_tiles_per_row * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = tile / core_tiles_per_row * CORE_TILE_HEIGHT;
    const uint list = tile * CORE_TILE_STRIDE;
    const uint n_listed = CORE_WORD(core_tiles, list) & ~CORE_TILE_INNER;
    const uint end_row = n_listed > 0u && column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    uint n_steps = 0u, n_evaluations = 0u;
    core_face_crossing track = core_no_crossing();
    uint row = first_row;
    while (row < end_row) {
        core_ray ray = core_pixel_ray(along, elvis_real(row));
        const uint pixel = row * core_size.x + column;
        const uint n_entries = core_look_beyond(pixel, ray) ? n_listed : 0u;
        core_face_descent descent = core_face_descent(list, n_entries, 0u, 0u);
        core_face_search search = core_face_search_begin(track.patch_index != CORE_NO_PATCH && n_entries > 0u);
        core_face_crossing nearest = core_no_crossing();
        while (core_goes_on(search, descent) && search.work < CORE_WORK_LIMIT) {
            search.work += 1u;
            while (search.patch_index == CORE_NO_PATCH && core_goes_on(search, descent) && search.work < CORE_WORK_LIMIT) {
                search.work += 1u;
                core_next_patch(ray, track, core_nearest_end(nearest), search, descent);
                if (search.patch_index != CORE_NO_PATCH || !core_has_more(descent)) {
                    break;
                }
            }
            core_step_on_patch(ray, along, search, descent, nearest);
            if (!core_goes_on(search, descent)) {
                break;
            }
        }
        const bool is_careful = search.is_careful || core_goes_on(search, descent);
        n_evaluations += core_show(pixel, ray, nearest, !is_careful, false);
        if (search.is_doubtful) {
            core_marks[pixel].flags |= CORE_FLAG_UNDECIDED_IN_FRONT;
        }
        if (is_careful) {
            core_list[atomicAdd(core_counts[3], 1u)] = pixel;
        }
        track = nearest;
        track.patch_index = is_careful ? CORE_NO_PATCH : nearest.patch_index;
        n_steps += search.n_steps;
        row += 1u;
        if (row >= end_row) {
            break;
        }
    }
    core_distrust_column(column, first_row, row, end_row, core_surface_number >> 31);
    if (end_row > first_row) {
        core_count(0u, n_evaluations);
        core_count(1u, n_steps);
    }
}
