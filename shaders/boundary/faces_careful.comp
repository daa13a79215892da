// Pixels that boundary/faces.comp left: their rays may cross a patch twice, or touch it.
//
// A patch is divided into squares until each is missed for certain, or crossed at most once for certain, which Newton's method
// then decides. In a square the face is its tangent plane at the middle and a remainder of at most q = Q h^2 in each coordinate
// (h: half its side; Q: bound of half the second derivatives over the patch). A direction g across the ray shows that the ray
// misses the square if
//
//     |g . (x - o)| > |g . x_a| + |g . x_b| + |g| . q,
//
// for g across one of the tangents or towards the square's middle. The linear part, seen along the ray, changes by the share L =
// 2 |rows| . q within the square; below one half there is one crossing at most. A square whose remainder is below the rounding of
// positions, and for which neither is known, is touched within rounding: the pixel is flagged as undecided, and the patch not
// taken as met there.

layout(local_size_x = 32) in;

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
#include "element/inside.glsl"

#define CORE_STEPS 10u
#define CORE_WORK_LIMIT 30000u
#define CORE_MAX_LEVEL 13u
// Each level leaves three squares behind.
#define CORE_SQUARES 48

void main() {
    const uint place_in_list = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = place_in_list < core_counts[3];
    const uint pixel = is_pixel ? core_list[place_in_list] : 0u;
    const uint column = pixel % core_size.x, row = pixel / core_size.x;
    core_ray ray = core_pixel_ray(core_cut_begin(elvis_real(column)), elvis_real(row));
    const bool is_wanted = core_look_beyond(pixel, ray);
    const uint list = (column / CORE_TILE_WIDTH + (row / CORE_TILE_HEIGHT) * core_tiles_per_row) * CORE_TILE_STRIDE;
    const uint n_entries = is_pixel && is_wanted ? core_tiles[list] & ~CORE_TILE_INNER : 0u;

    core_nearest_face nearest = core_nothing_yet();
    uint stack[CORE_STACK_SIZE];
    uint squares[CORE_SQUARES];
    uint stack_size = 0u, n_squares = 0u, entry = 0u, work = 0u, steps = 0u, n_steps = 0u;
    // The patch, and the square of it that is looked at: level, column, row.
    uint patch_index = CORE_NO_FACE, face = 0u, square_word = 0u, square = 0u;
    bool is_polishing = false;
    // Nearest place where a patch is touched within rounding.
    elvis_real touched_t = elvis_real(3.2e38LF);
    elvis_real u = elvis_real(0), v = elvis_real(0), slope = elvis_real(0);
    while ((n_squares > 0u || is_polishing || stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (n_squares == 0u && !is_polishing && (stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
            work += 1u;
            const bool is_popped = stack_size > 0u;
            const uint at = list + 1u + 2u * min(entry, max(n_entries, 1u) - 1u);
            const uint word = is_popped ? stack[stack_size - 1u] : core_tiles[at];
            const bool is_behind = !is_popped && uintBitsToFloat(core_tiles[at + 1u]) > float(nearest.t + nearest.slack);
            entry = is_behind ? n_entries : entry + (is_popped ? 0u : 1u);
            stack_size -= is_popped ? 1u : 0u;
            const bool is_inner = (word & CORE_TILE_INNER) != 0u;
            if (!is_behind && !is_inner) {
                const core_patch_meeting meeting = core_meet_patch(word, ray.box_origin, vec3(ray.direction), ray.far,
                        float(ray.least_t),
                                                                   float(nearest.t + nearest.slack));
                const uvec4 more = elvis_fetch4_core_patches(word, 4u);
                patch_index = word;
                square_word = more.w;
                face = more.z;
                squares[0] = 0u;
                n_squares = meeting.is_met ? 1u : 0u;
            }
            if (!is_behind && is_inner) {
                const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
                for (uint k = 0u; k < 2u; ++k) {
                    const core_node part = core_fetch_node(node.child + k);
                    stack[stack_size] = part.is_leaf ? part.child : (node.child + k) | CORE_TILE_INNER;
                    stack_size += core_box_entry(part, ray) <= float(nearest.t + nearest.slack) ? 1u : 0u;
                }
            }
            if (n_squares > 0u || is_polishing || (stack_size == 0u && entry >= n_entries)) {
                break;
            }
        }

        const bool is_active = n_squares > 0u || is_polishing;
        const bool is_square = is_active && !is_polishing;
        n_squares -= is_square ? 1u : 0u;
        square = is_square ? squares[n_squares] : square;
        const core_square of_patch = core_square_of(square_word);
        const uint level = square & 15u, i = (square >> 4) & 8191u, j = square >> 17;
        // In the patch, then on the face.
        const elvis_real part = exp2(-float(level));
        const elvis_real middle_a = elvis_real(2u * i + 1u) * part - elvis_real(1);
        const elvis_real middle_b = elvis_real(2u * j + 1u) * part - elvis_real(1);
        const elvis_real middle_u = elvis_real(of_patch.a) + elvis_real(of_patch.size) * middle_a;
        const elvis_real middle_v = elvis_real(of_patch.b) + elvis_real(of_patch.size) * middle_b;
        const elvis_real half_size = elvis_real(of_patch.size) * part;
        u = is_square ? middle_u : u;
        v = is_square ? middle_v : v;

        const uvec4 place = elvis_fetch4_core_faces(face, 0u);
        const int local_face = int(place.y);
        const elvis_real misfit = elvis_real(uintBitsToFloat(place.w));
        const core_face_point point = core_face_at(face, place.x, local_face, u, v);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(place.x);
        const core_face_step s = core_face_newton(point, shift, ray, misfit);
        n_steps += is_active ? 1u : 0u;

        // The square: tangents over half its side.
        const uint safe_patch = patch_index == CORE_NO_FACE ? 0u : patch_index;
        const elvis_vec3 bound = elvis_vec3(uintBitsToFloat(elvis_fetch4_core_patches(safe_patch, 5u).xyz));
        const elvis_vec3 q = part * part * bound;
        const elvis_vec3 tangent_a = half_size * point.along_u, tangent_b = half_size * point.along_v;
        const elvis_vec3 away = point.x - (shift + ray.origin);
        const elvis_vec3 terms = abs(shift) + abs(point.x) + abs(tangent_a) + abs(tangent_b) + abs(away);
        const elvis_vec3 noise = elvis_vec3(ray.error + misfit) + elvis_real(8) * CORE_ROUNDOFF * terms;
        const elvis_vec3 room = q + noise;
        const elvis_vec3 d = ray.direction;
        const elvis_real per_length = elvis_real(1) / dot(d, d);
        const elvis_vec3 g1 = cross(d, tangent_a), g2 = cross(d, tangent_b);
        const elvis_real t_middle = dot(d, away) * per_length;
        const elvis_vec3 g3 = away - t_middle * d;
        const elvis_real w1 = abs(dot(g1, away)) - abs(dot(g1, tangent_b)) - dot(abs(g1), room);
        const elvis_real w2 = abs(dot(g2, away)) - abs(dot(g2, tangent_a)) - dot(abs(g2), room);
        const elvis_real w3 = abs(dot(g3, away)) - abs(dot(g3, tangent_a)) - abs(dot(g3, tangent_b)) - dot(abs(g3), room);
        const elvis_real t_reach = (abs(dot(d, tangent_a)) + abs(dot(d, tangent_b)) + dot(abs(d), room)) * per_length;
        const bool is_upper = of_patch.is_diagonal && middle_a + middle_b - elvis_real(2) * part > elvis_real(0);
        const bool is_elsewhere = t_middle - t_reach > nearest.t + nearest.slack || t_middle + t_reach < ray.least_t;
        const bool is_excluded = is_upper || is_elsewhere || max(max(w1, w2), w3) > elvis_real(0);
        // Over the square enlarged by CORE_PATCH_REACH, in which the bound holds, too.
        const elvis_real turned = max(dot(abs(s.row_u), q), dot(abs(s.row_v), q)) / half_size;
        const elvis_real l = s.is_regular ? elvis_real(2 * CORE_PATCH_REACH) * turned
                                          : elvis_real(1);
        const bool is_single = l < elvis_real(0.5LF);
        const elvis_real largest_q = max(max(q.x, q.y), q.z), largest_noise = max(max(noise.x, noise.y), noise.z);
        const bool is_rounding = largest_q <= elvis_real(0.25LF) * largest_noise || level == CORE_MAX_LEVEL;

        // Newton's method, from the middle of the square.
        const bool begins = is_square && !is_excluded && is_single;
        is_polishing = is_polishing || begins;
        slope = begins ? l : slope;
        steps = begins ? 1u : steps + 1u;
        const elvis_real new_u = u + s.step_u, new_v = v + s.step_v;
        const elvis_real step = max(abs(s.step_u), abs(s.step_v));
        // q bounds half the second derivative: the bend is half of the slope.
        const elvis_real left = half_size * core_patch_prediction_error(float(slope), float(slope), step / half_size);
        const bool has_converged = s.is_regular && (step <= s.error || left <= elvis_real(0.5LF) * s.error);
        const elvis_real outside = max(abs(new_u - middle_u), abs(new_v - middle_v)) - half_size;
        // On the diagonal of a triangle.
        const elvis_real above = of_patch.is_diagonal ? new_u - elvis_real(of_patch.a) + new_v - elvis_real(of_patch.b)
                                                              : elvis_real(-1);
        const bool has_missed = s.is_regular && max(outside, above) > elvis_real(2) * (left + elvis_real(2) * s.error);
        // A crossing beyond the square's edge keeps it from either; it is farther beyond that of a part.
        const bool has_stalled = is_polishing && !has_converged && !has_missed && steps == CORE_STEPS;
        const bool is_touching = is_rounding && (has_stalled || (is_square && !is_excluded && !is_single));
        touched_t = is_touching ? min(touched_t, t_middle - t_reach) : touched_t;
        const bool splits = (has_stalled || (is_square && !is_excluded && !is_single)) && !is_rounding;
        bool is_hit = is_polishing && has_converged && max(outside, above) <= elvis_real(2) * s.error &&
                s.t > ray.least_t + ray.widths_behind * s.width;
#if ELVIS_HAS_INSIDE
        is_hit = is_hit && core_is_within(place.x, core_face_xi(local_face, new_u, new_v), elvis_vec3(s.error));
#endif
        const elvis_real excess = core_face_excess(new_u, new_v, square_word);
        core_take_crossing(nearest, is_hit, face, place.z, patch_index, core_partner_key(square_word, s.across), new_u, new_v,
                           excess >= elvis_real(-2) * s.error, s, elvis_vec3(0));
        const bool ends = has_converged || has_missed || has_stalled;
        is_polishing = is_polishing && !ends;
        if (splits) {
            for (uint k = 0u; k < 4u; ++k) {
                squares[n_squares] = (level + 1u) | ((2u * i + (k & 1u)) << 4) | ((2u * j + (k >> 1)) << 17);
                n_squares += 1u;
            }
        }

        const elvis_real reach = elvis_real(CORE_PATCH_REACH) * half_size;
        u = clamp(new_u, middle_u - reach, middle_u + reach);
        v = clamp(new_v, middle_v - reach, middle_v + reach);
        if (n_squares == 0u && !is_polishing && stack_size == 0u && entry >= n_entries) {
            break;
        }
    }

    core_location found = core_location_of(nearest, n_steps);
    found.is_cut_short = n_squares > 0u || is_polishing || stack_size > 0u || entry < n_entries ||
            core_has_driver_given_up(core_surface >> 31);
    const bool has_found = found.element != CORE_NO_ELEMENT;
    const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
    uint n_evaluations = 0u;
    if (is_pixel && (has_found || found.is_cut_short)) {
        n_evaluations = core_show(pixel, ray, nearest, found, value);
    }
    if (is_pixel && touched_t <= nearest.t + nearest.slack) {
        core_marks[pixel].flags |= CORE_FLAG_UNDECIDED;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    const uint all_steps = subgroupAdd(n_steps);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
        atomicAdd(core_counts[1], all_steps);
    }
}
