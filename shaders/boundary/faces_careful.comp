// Faces in the pixels that boundary/faces.comp leaves: their rays may cross a patch twice, or touch it.
//
// A patch is divided into squares until each is missed for certain, or crossed at most once for certain, which Newton's method
// then decides. In a square the face is its tangent plane at the middle and a remainder of at most q = Q h^2 in each coordinate
// (h: half its side; Q: bound of half the second derivatives over the patch). A direction g across the ray shows that the ray
// misses the square if
//
//     |g . (x - o)| > |g . x_a| + |g . x_b| + |g| . q,
//
// for g across one of the tangents or towards the square's middle; x - o stands for the part of it that is across the ray, which is small
// near the ray and so keeps its digits. g itself has few where a tangent runs along the ray. The linear part, seen along the ray, changes by the share L =
// 2 |rows| . q within the square; below one half there is one crossing at most. Where a square's remainder is below the rounding of
// positions, and still neither is known, the ray touches the patch within rounding: the pixel is flagged as undecided, and no crossing
// is taken there.

layout(local_size_x = 32) in;

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
// Squares of the patch that wait: each level leaves three behind.
#define CORE_OTHER_WORDS 48
#include "boundary/face_descent.glsl"
#define CORE_SQUARE(index) core_stack[CORE_STACK_SIZE + (index)]

#define CORE_STEPS 10u
#define CORE_WORK_LIMIT 30000u
#define CORE_MOST_LEVEL 13u

struct core_careful_search {
    // The patch at hand, its face, and the word of its square.
    uint patch_index, face, square_word;
    // Of the patch: how many squares wait; the one at hand: level, column, row.
    uint n_squares, square;
    // Newton's method is at (u, v) in the square, in which the linear part changes by the share `slope`.
    bool is_polishing;
    elvis_real u, v, slope;
    uint steps;
    // The nearest place where a patch is touched within rounding.
    elvis_real touched_t;
    // A crossing too near to the eye, or not.
    bool is_doubtful;
    uint n_steps, work;
};

core_careful_search core_careful_search_begin() {
    const elvis_real zero = elvis_real(0);
    return core_careful_search(CORE_NO_PATCH, 0u, 0u, 0u, 0u, false, zero, zero, zero, 0u, elvis_real(3.2e38LF), false, 0u, 0u);
}

bool core_has_patch(core_careful_search search) { return search.n_squares > 0u || search.is_polishing; }
bool core_goes_on(core_careful_search search, core_face_descent descent) { return core_has_patch(search) || core_has_more(descent); }

// To the next patch if the ray can meet it.
void core_next_patch(core_ray ray, float end_t, inout core_careful_search search, inout core_face_descent descent) {
    const uint word = core_next_word(true, end_t, descent);
    if ((word & CORE_TILE_INNER) == 0u) {
        const core_patch_meeting meeting =
            core_meet_patch(word, ray.box_origin, vec3(ray.direction), ray.far, float(ray.least_t), end_t);
        const uvec4 more = elvis_fetch4_core_patches(word, 4u);
        search.patch_index = word;
        search.square_word = more.w;
        search.face = more.z;
        CORE_SQUARE(0u) = 0u;
        search.n_squares = meeting.is_met ? 1u : 0u;
    }
    core_descend(word, ray, end_t, false, descent);
}

// A square of a patch.
struct core_patch_square {
    uint level, column, row;
    // Half its side: over the patch's, and on the face.
    elvis_real share, half_size;
    // Its middle in the patch and on the face.
    elvis_real a, b, u, v;
};

core_patch_square core_patch_square_of(uint word, core_square patch_square) {
    core_patch_square square;
    square.level = word & 15u;
    square.column = (word >> 4) & 8191u;
    square.row = word >> 17;
    square.share = exp2(-float(square.level));
    square.half_size = elvis_real(patch_square.size) * square.share;
    square.a = elvis_real(2u * square.column + 1u) * square.share - elvis_real(1);
    square.b = elvis_real(2u * square.row + 1u) * square.share - elvis_real(1);
    square.u = elvis_real(patch_square.a) + elvis_real(patch_square.size) * square.a;
    square.v = elvis_real(patch_square.b) + elvis_real(patch_square.size) * square.b;
    return square;
}

struct core_square_verdict {
    // The ray misses the square, or meets it where nothing is wanted; it crosses the square at most once.
    bool is_excluded, is_single;
    // What is not known of it is rounding.
    bool is_rounding;
    // L; and where the ray meets the square at the least.
    elvis_real slope, least_t;
};

// By how much the direction g = d x tangent shows that the ray misses: `across` leads from the ray to the square's middle.
elvis_real core_gap(elvis_vec3 d, elvis_vec3 tangent, elvis_vec3 other_tangent, elvis_vec3 across, elvis_vec3 room) {
    const elvis_vec3 g = cross(d, tangent);
    // Each product in g is rounded, and they may cancel.
    const elvis_real rounding = elvis_real(4) * CORE_ROUNDOFF * core_norm1(d) * core_norm1(tangent);
    return abs(dot(g, across)) - abs(dot(g, other_tangent)) - dot(abs(g), room) -
           rounding * (core_norm1(across) + core_norm1(other_tangent));
}

core_square_verdict core_judge_square(core_ray ray, core_face_newton_step s, uint patch_index, core_square patch_square,
                                      core_patch_square square, core_face_crossing nearest) {
    const uint safe_patch = patch_index == CORE_NO_PATCH ? 0u : patch_index;
    const elvis_vec3 bound = elvis_vec3(uintBitsToFloat(elvis_fetch4_core_patches(safe_patch, 5u).xyz));
    const elvis_vec3 q = square.share * square.share * bound;
    const elvis_vec3 tangent_a = square.half_size * s.point.along_u, tangent_b = square.half_size * s.point.along_v;
    const elvis_vec3 away = s.point.x - (s.shift + ray.origin);
    const elvis_vec3 terms = abs(s.shift) + abs(s.point.x) + abs(tangent_a) + abs(tangent_b) + abs(away);
    const elvis_vec3 noise = elvis_vec3(ray.error + s.misfit) + elvis_real(8) * CORE_ROUNDOFF * terms;
    const elvis_vec3 room = q + noise, d = ray.direction;
    const elvis_real per_length = elvis_real(1) / dot(d, d);
    const elvis_real t_middle = dot(d, away) * per_length;
    const elvis_vec3 across = away - t_middle * d;
    const elvis_real gap1 = core_gap(d, tangent_a, tangent_b, across, room);
    const elvis_real gap2 = core_gap(d, tangent_b, tangent_a, across, room);
    const elvis_real gap3 =
        dot(across, across) - abs(dot(across, tangent_a)) - abs(dot(across, tangent_b)) - dot(abs(across), room);
    const elvis_real t_reach = (abs(dot(d, tangent_a)) + abs(dot(d, tangent_b)) + dot(abs(d), room)) * per_length;
    const bool is_upper = patch_square.is_diagonal && square.a + square.b - elvis_real(2) * square.share > elvis_real(0);
    const bool is_elsewhere = t_middle - t_reach > nearest.t + nearest.slack || t_middle + t_reach < ray.least_t;
    core_square_verdict verdict;
    verdict.is_excluded = is_upper || is_elsewhere || max(max(gap1, gap2), gap3) > elvis_real(0);
    // Over the square enlarged by CORE_PATCH_REACH, in which the bound holds, too.
    const elvis_real change = max(dot(abs(s.row_u), q), dot(abs(s.row_v), q)) / square.half_size;
    verdict.slope = s.is_regular ? elvis_real(2 * CORE_PATCH_REACH) * change : elvis_real(1);
    verdict.is_single = verdict.slope < elvis_real(0.5LF);
    verdict.is_rounding = max(max(q.x, q.y), q.z) <= elvis_real(0.25LF) * max(max(noise.x, noise.y), noise.z) ||
                          square.level == CORE_MOST_LEVEL;
    verdict.least_t = t_middle - t_reach;
    return verdict;
}

void core_split(core_patch_square square, inout core_careful_search search) {
    for (uint k = 0u; k < 4u; ++k) {
        CORE_SQUARE(search.n_squares) =
            (square.level + 1u) | ((2u * square.column + (k & 1u)) << 4) | ((2u * square.row + (k >> 1)) << 17);
        search.n_squares += 1u;
    }
}

// The next square, or the next step of Newton's method in the one at hand.
void core_step_in_square(core_ray ray, inout core_careful_search search, inout core_face_crossing nearest) {
    const bool is_active = core_has_patch(search), is_square = is_active && !search.is_polishing;
    search.n_squares -= is_square ? 1u : 0u;
    search.square = is_square ? CORE_SQUARE(search.n_squares) : search.square;
    const core_square patch_square = core_square_of(search.square_word);
    const core_patch_square square = core_patch_square_of(search.square, patch_square);
    search.u = is_square ? square.u : search.u;
    search.v = is_square ? square.v : search.v;
    const core_face_newton_step s = core_face_newton(search.face, search.u, search.v, ray);
    search.n_steps += is_active ? 1u : 0u;
    const core_square_verdict of_square = core_judge_square(ray, s, search.patch_index, patch_square, square, nearest);

    // Newton's method, from the middle of the square.
    const bool begins = is_square && !of_square.is_excluded && of_square.is_single;
    search.is_polishing = search.is_polishing || begins;
    search.slope = begins ? of_square.slope : search.slope;
    search.steps = begins ? 1u : search.steps + 1u;
    const elvis_real u = search.u + s.step_u, v = search.v + s.step_v;
    // q bounds half the second derivative: the bend is half of the slope.
    const elvis_real step_length = max(abs(s.step_u), abs(s.step_v));
    const elvis_real left = square.half_size *
                            core_patch_prediction_error(float(search.slope), float(search.slope), step_length / square.half_size);
    const elvis_real outside = max(abs(u - square.u), abs(v - square.v)) - square.half_size;
    const elvis_real from_middle = u - elvis_real(patch_square.a) + v - elvis_real(patch_square.b);
    const elvis_real above_diagonal = patch_square.is_diagonal ? from_middle : elvis_real(-1);
    const core_face_verdict of_step = core_judge_face_step(ray, s, u, v, max(outside, above_diagonal), left);
    core_take_crossing(search.is_polishing && of_step.is_hit,
                       core_face_crossing_at(search.face, search.patch_index, search.square_word, u, v, s, elvis_vec3(0)), nearest);
    search.is_doubtful = search.is_doubtful || (search.is_polishing && of_step.is_doubtful);

    // Near the square's edge a step may show neither a crossing nor a miss; smaller squares have their edges elsewhere.
    const bool is_done = of_step.has_converged || of_step.has_missed;
    const bool has_stalled = search.is_polishing && !is_done && search.steps == CORE_STEPS;
    const bool is_open = has_stalled || (is_square && !of_square.is_excluded && !of_square.is_single);
    search.touched_t = is_open && of_square.is_rounding ? min(search.touched_t, of_square.least_t) : search.touched_t;
    search.is_polishing = search.is_polishing && !is_done && !has_stalled;
    if (is_open && !of_square.is_rounding) {
        core_split(square, search);
    }
    const elvis_real reach = elvis_real(CORE_PATCH_REACH) * square.half_size;
    search.u = clamp(u, square.u - reach, square.u + reach);
    search.v = clamp(v, square.v - reach, square.v + reach);
}

void main() {
    const uint place_in_list = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = place_in_list < core_counts[3];
    const uint pixel = is_pixel ? core_list[place_in_list] : 0u;
    const uint column = pixel % core_size.x, row = pixel / core_size.x;
    core_ray ray = core_pixel_ray(core_cut_begin(elvis_real(column)), elvis_real(row));
    const bool is_wanted = core_look_beyond(pixel, ray);
    const uint list = (column / CORE_TILE_WIDTH + (row / CORE_TILE_HEIGHT) * core_tiles_per_row) * CORE_TILE_STRIDE;
    const uint n_entries = is_pixel && is_wanted ? CORE_WORD(core_tiles, list) & ~CORE_TILE_INNER : 0u;

    core_face_descent descent = core_face_descent(list, n_entries, 0u, 0u);
    core_careful_search search = core_careful_search_begin();
    core_face_crossing nearest = core_no_crossing();
    while (core_goes_on(search, descent) && search.work < CORE_WORK_LIMIT) {
        search.work += 1u;
        while (!core_has_patch(search) && core_has_more(descent) && search.work < CORE_WORK_LIMIT) {
            search.work += 1u;
            core_next_patch(ray, core_nearest_end(nearest), search, descent);
            if (core_has_patch(search) || !core_has_more(descent)) {
                break;
            }
        }
        core_step_in_square(ray, search, nearest);
        if (!core_goes_on(search, descent)) {
            break;
        }
    }
    const bool is_cut_short = core_goes_on(search, descent) || core_has_driver_given_up(core_surface_number >> 31);
    const uint n_evaluations = core_show(pixel, ray, nearest, is_pixel, is_cut_short);
    if (is_pixel && (search.is_doubtful || search.touched_t <= nearest.t + nearest.slack)) {
        core_marks[pixel].flags |= CORE_FLAG_UNDECIDED_IN_FRONT;
    }
    core_count(0u, n_evaluations);
    core_count(1u, search.n_steps);
}
