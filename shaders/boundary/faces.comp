// Faces of the elements of one class, or two-dimensional elements, seen along the rays of a picture: the nearest crossing, and the
// field there.
//
// A face is a map of (u, v), both from -1 to 1, with u + v <= 0 in a triangle. A ray o + t d meets it where x(u, v) = o + t d.
// Patches of it come with a linear model and bounds of the rest (boundary/face_patch.glsl), which tell most patches that a ray
// misses before anything is evaluated, give Newton's method its start, and say where no ray like this one crosses a patch twice.
// Pixels that meet a patch for which that is not certain, near silhouettes, are left to boundary/faces_careful.comp.
//
// A work group is a tile of pixels, an invocation one of its columns; its list (tiles/ray_tiles.comp) is in the order of
// depth, so that the search ends at the first patch behind the crossing found. The next pixel of a column starts where this one's
// crossing moves to. Tiles whose lists hold inner nodes of the hierarchy are drawn by a second version (CORE_DESCENDS).
//
// One evaluation of a face an iteration, whatever patch a lane is at, so that lanes do not wait for each other.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "element/face_frame.glsl"
#include "boundary/face_patch.glsl"
#include "boundary/face_point.glsl"
#include "tiles/ray_tiles.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "picture/pixel_ray.glsl"
#include "boundary/face_rays.glsl"
#include "boundary/face_surface.glsl"
#include "picture/distrust_column.glsl"
#include "element/inside.glsl"
#define CORE_LISTED_BINDING 9
#include "tiles/listed_tile.glsl"

#define CORE_STEPS 8u
// Iterations and patches of one pixel: a tile's pixels together stay below where drivers end loops.
#define CORE_WORK_LIMIT 1500u

void main() {
    const uint tile = core_listed_tile(core_first);
    const uint column = tile % core_tiles_per_row * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = tile / core_tiles_per_row * CORE_TILE_HEIGHT;
    const uint list = tile * CORE_TILE_STRIDE;
    const uint n_listed = core_tiles[list] & ~CORE_TILE_INNER;
    const uint end_row = n_listed > 0u && column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    uint n_all_steps = 0u, n_evaluations = 0u;
    uint tracked = CORE_NO_FACE;
    elvis_real tracked_u = elvis_real(0), tracked_v = elvis_real(0);
    uint row = first_row;
    while (row < end_row) {
        core_ray ray = core_pixel_ray(along, elvis_real(row));
        const uint pixel = row * core_size.x + column;
        const uint n_entries = core_look_beyond(pixel, ray) ? n_listed : 0u;
        core_nearest_face nearest = core_nothing_yet();
#if CORE_DESCENDS
        uint stack[CORE_STACK_SIZE];
#define CORE_TOP stack[stack_size - 1u]
#else
        // A stack costs a quarter of the time even where it stays empty.
#define CORE_TOP 0u
#endif
        uint stack_size = 0u, entry = 0u, work = 0u, steps = 0u, n_steps = 0u;
        bool is_careful = false;
        // The patch that held the column's last crossing comes first.
        bool is_tracking = tracked != CORE_NO_FACE && n_entries > 0u;
        bool is_from_track = false;
        uint patch_index = CORE_NO_FACE;
        elvis_real u = elvis_real(0), v = elvis_real(0);
        float slope = 0.0, bend = 0.0;
        uint square_word = 0u, face = 0u;
        while ((patch_index != CORE_NO_FACE || is_tracking || stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
            work += 1u;
            while (patch_index == CORE_NO_FACE && (is_tracking || stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
                work += 1u;
                const bool is_popped = !is_tracking && stack_size > 0u;
                const bool is_next = !is_tracking && !is_popped;
                const uint at = list + 1u + 2u * min(entry, n_listed - 1u);
                const float entry_t = uintBitsToFloat(core_tiles[at + 1u]);
                const uint word = is_tracking ? tracked : is_popped ? CORE_TOP : core_tiles[at];
                // All further entries are behind the crossing.
                const bool is_behind = is_next && entry_t > float(nearest.t + nearest.slack);
                entry = is_behind ? n_entries : entry + (is_next ? 1u : 0u);
                stack_size -= is_popped ? 1u : 0u;
                const bool is_inner = (word & CORE_TILE_INNER) != 0u;
                const bool is_again = !is_tracking && word == tracked;
                const bool is_tried = !is_behind && !is_inner && !is_again;
                is_from_track = is_tracking;
                is_tracking = false;
                // Without a guard, which would cost more than it saves: few iterations come without a patch.
                const uint tried = is_tried ? word : 0u;
                const core_patch_meeting meeting = core_meet_patch(tried, ray.box_origin, vec3(ray.direction), ray.far,
                        float(ray.least_t),
                                                                   float(nearest.t + nearest.slack));
                const bool is_met = is_tried && meeting.is_met;
                is_careful = is_careful || (is_met && !meeting.is_single);
                patch_index = is_met && meeting.is_single ? word : CORE_NO_FACE;
                const uvec4 more = elvis_fetch4_core_patches(tried, 4u);
                square_word = more.w;
                face = more.z;
                const core_square square = core_square_of(square_word);
                const elvis_real size = elvis_real(square.size);
                u = is_from_track ? tracked_u : elvis_real(square.a) + size * elvis_real(clamp(meeting.a, -1.0, 1.0));
                v = is_from_track ? tracked_v : elvis_real(square.b) + size * elvis_real(clamp(meeting.b, -1.0, 1.0));
                slope = meeting.slope;
                bend = meeting.bend;
                steps = 0u;
#if CORE_DESCENDS
                if (!is_behind && is_inner) {
                    const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
                    const core_node one = core_fetch_node(node.child), other = core_fetch_node(node.child + 1u);
                    const float one_t = core_box_entry(one, ray), other_t = core_box_entry(other, ray);
                    const float most = float(nearest.t + nearest.slack);
                    const uint one_word = one.is_leaf ? one.child : node.child | CORE_TILE_INNER;
                    const uint other_word = other.is_leaf ? other.child : (node.child + 1u) | CORE_TILE_INNER;
                    // The nearer one first.
                    const bool is_one_nearer = one_t <= other_t;
                    const uint n_met = (one_t <= most ? 1u : 0u) + (other_t <= most ? 1u : 0u);
                    stack[stack_size] = n_met == 2u ? (is_one_nearer ? other_word : one_word) 
                                                      : (one_t <= most ? one_word : other_word);
                    stack[stack_size + 1u] = is_one_nearer ? one_word : other_word;
                    stack_size += n_met;
                }
#endif
                // Nothing more is done here.
                entry = is_careful ? n_entries : entry;
                stack_size = is_careful ? 0u : stack_size;
                if (patch_index != CORE_NO_FACE || (stack_size == 0u && entry >= n_entries)) {
                    break;
                }
            }

            const bool is_active = patch_index != CORE_NO_FACE;
            const uvec4 place = elvis_fetch4_core_faces(face, 0u);
            const int local_face = int(place.y);
            const core_face_point point = core_face_at(face, place.x, local_face, u, v);
            const core_face_step s = core_face_newton(point, core_reference.xyz - elvis_origin(place.x), ray,
                                                      elvis_real(uintBitsToFloat(place.w)));
            const core_square square = core_square_of(square_word);
            const elvis_real half_size = elvis_real(square.size), per_size = elvis_real(1) / half_size;
            const elvis_real new_u = u + s.step_u, new_v = v + s.step_v;
            const elvis_real a = (new_u - elvis_real(square.a)) * per_size, b = (new_v - elvis_real(square.b)) * per_size;
            const elvis_real step = max(abs(s.step_u), abs(s.step_v));
            const elvis_real left = half_size * core_patch_prediction_error(slope, bend, step * per_size);
            const bool has_converged = s.is_regular && (step <= s.error || left <= elvis_real(0.5LF) * s.error);
            const elvis_real outside = half_size * (square.is_diagonal ? max(max(abs(a), abs(b)) - elvis_real(1), a + b)
                                                                       : max(abs(a), abs(b)) - elvis_real(1));
            // The sum a + b is off by both errors.
            const bool has_missed = s.is_regular && outside > elvis_real(2) * (left + elvis_real(2) * s.error);
            steps += is_active ? 1u : 0u;
            n_steps += is_active ? 1u : 0u;
            const bool has_failed = is_active && !has_converged && !has_missed && steps == CORE_STEPS;
            is_careful = is_careful || has_failed;
            bool is_hit = is_active && has_converged && outside <= elvis_real(2) * s.error &&
                    s.t > ray.least_t + ray.widths_behind * s.width;
#if ELVIS_HAS_INSIDE
            is_hit = is_hit && core_is_within(place.x, core_face_xi(local_face, new_u, new_v), elvis_vec3(s.error));
#endif
            const elvis_real excess = core_face_excess(new_u, new_v, square_word);
            const elvis_vec3 motion = along.base_row.xyz + s.t * along.direction_row.xyz;
            core_take_crossing(nearest, is_hit, face, place.z, patch_index, core_partner_key(square_word, s.across), new_u, new_v,
                               excess >= elvis_real(-2) * s.error, s, motion);
            const bool ends = !is_active || has_converged || has_missed || is_careful;
            patch_index = ends ? CORE_NO_FACE : patch_index;
            entry = is_careful ? n_entries : entry;
            stack_size = is_careful ? 0u : stack_size;
            // Points are kept where the bounds hold.
            const elvis_real reach = elvis_real(CORE_PATCH_REACH) * half_size;
            u = clamp(new_u, elvis_real(square.a) - reach, elvis_real(square.a) + reach);
            v = clamp(new_v, elvis_real(square.b) - reach, elvis_real(square.b) + reach);
            if (patch_index == CORE_NO_FACE && stack_size == 0u && entry >= n_entries) {
                break;
            }
        }
        is_careful = is_careful || patch_index != CORE_NO_FACE || stack_size > 0u || entry < n_entries;
        tracked = is_careful ? CORE_NO_FACE : nearest.patch_index;
        tracked_u = nearest.next_u;
        tracked_v = nearest.next_v;
        const core_location found = core_location_of(nearest, n_steps);
        const bool has_found = found.element != CORE_NO_ELEMENT;
        const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
        if (has_found && !is_careful) {
            n_evaluations += core_show(pixel, ray, nearest, found, value);
        }
        if (is_careful) {
            core_list[atomicAdd(core_counts[3], 1u)] = pixel;
        }
        n_all_steps += n_steps;
        row += 1u;
        if (row >= end_row) {
            break;
        }
    }
    // Then no pixel of the column is to be trusted.
    const bool is_cut_short = end_row > first_row && (row < end_row || core_has_driver_given_up(core_surface >> 31));
    core_distrust_column(column, first_row, is_cut_short ? end_row : first_row);
    if (end_row > first_row) {
        const uint all_evaluations = subgroupAdd(n_evaluations);
        const uint all_steps = subgroupAdd(n_all_steps);
        if (subgroupElect()) {
            atomicAdd(core_counts[0], all_evaluations);
            atomicAdd(core_counts[1], all_steps);
        }
    }
}
