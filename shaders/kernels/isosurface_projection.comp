// The first point of the ray of each listed pixel at which the field takes one of the isovalues, in the elements of one class, by
// projection of the field along the ray (Nelson & Kirby, Ray-tracing polymorphic multidomain spectral/hp elements for isosurface
// rendering, 2006).
//
// Elements whose range holds an isovalue are visited nearest first, and in each the parts of the ray inside, from exact entry to
// exact exit (library/ray_part.glsl). Along a part the field is sampled and becomes a polynomial (library/segment_fit.glsl), whose
// degree is raised, and then the part halved, until the error E is small beside how much the polynomial varies. Beside values each
// sample has the field's slope along the ray, which the polynomial must have, too: few values alone can deceive. A piece without an
// isovalue within E of the polynomial's Bernstein coefficients is left out: that is verified, not certified. Else the polynomial's
// crossings are looked at in order. Each is polished on the field itself by Newton's method along the ray; it is taken if
//
//     E shows that the field crosses in the bracket in which the root was found    or
//     the field is seen on both sides, or surely keeps its slope within what rounding moves the root.
//
// Where neither holds the piece is halved as long as E is more than rounding; then the pixel is undecided.
//
// With CORE_PLAIN the method is that of 2006: each part as one polynomial of fixed degree, whose first root is the answer.

layout(local_size_x = 32) in;

#include "library/precision.glsl"
#include "library/cut_frame.glsl"
#include "library/hierarchy.glsl"
#include "library/samples.glsl"
#include "library/place.glsl"
#include "library/finite.glsl"
#include "library/pixel_ray.glsl"
#include "library/isosurface_bindings.glsl"
#include "library/isosurface_blur.glsl"

layout(set = 0, binding = 5, std430) readonly buffer core_list_block { uint core_list[]; };
layout(push_constant) uniform core_parameters {
    uint core_width;
    // Of the list.
    uint core_first, core_end;
    // Counted from 1; 0 is no surface.
    uint core_surface;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_has_beyond;
};

#include "library/isovalues.glsl"
elvis_real core_level_value(uint i) { return core_isovalues[i]; }

#define CORE_CENTRE core_reference.xyz
#define CORE_PART_CURVATURE(element) elvis_real(elvis_fetch_core_curvatures(element, 0u))

#include "library/look_beyond.glsl"
#include "library/driver_limit.glsl"
#include "library/shown_model.glsl"
// Of elements that are curved more than usual a part that is missed would be a crossing missed.
#define CORE_ASSUMED_CURVATURE elvis_real(16)
#define CORE_CERTAIN_TURNS 96u
#define CORE_PART_TURNS 160u
#include "library/ray_part.glsl"
#include "library/ray_sample.glsl"
#include "library/level_model.glsl"
#include "library/level_span.glsl"
#include "library/segment_polynomial.glsl"
#include "library/segment_colleague.glsl"

// Turns of a pixel, with all loops inside below where drivers end them.
#define CORE_WORK_LIMIT 2500u
// Parts of a ray in one element.
#define CORE_MOST_PARTS 16u
#define CORE_POLISH_TURNS 40u
#define CORE_CANDIDATE_TURNS 16u

// Times that a part of a ray may be halved. A field that is smooth needs few; that its derivatives jump is seen at the last.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_MOST_LEVELS 14u
// Distance within which the ends of parts are wanted, over the volume's size.
#define CORE_END_TOLERANCE elvis_real(2e-14LF)
#else
#define CORE_MOST_LEVELS 8u
#define CORE_END_TOLERANCE elvis_real(2.5e-7LF)
#endif
// E over how much the polynomial varies, above which it is not believed.
#if CORE_USES_COLLEAGUE
// Eigenvalues tell no error: as little as there can be.
#define CORE_ROUGH elvis_real(0)
#else
#define CORE_ROUGH elvis_real(1e-3LF)
#endif
// What slopes that differ say about E, over the same, below which it may be the gradient's own error.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_LEAST_SLOPE_ERROR elvis_real(1e-6LF)
#else
#define CORE_LEAST_SLOPE_ERROR elvis_real(1e-4LF)
#endif

#define CORE_PHASE_SEEK 0u
#define CORE_PHASE_CLIP 1u
#define CORE_PHASE_SAMPLE 2u
#define CORE_PHASE_SOLVE 3u
#define CORE_PHASE_POLISH 4u
// A piece, a part or an element is done with.
#define CORE_PHASE_PIECE_DONE 5u
#define CORE_PHASE_PART_DONE 6u

#include "library/nearest_crossing.glsl"
#include "library/segment_candidate.glsl"
#include "library/segment_pieces.glsl"

void main() {
    const uint place = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = place < core_end;
    const uint pixel = is_pixel ? core_list[place] : 0u;
    const core_cut_column along = core_cut_begin(elvis_real(pixel % core_width));
    core_ray ray = core_pixel_ray(along, elvis_real(pixel / core_width));
    const bool is_wanted = core_look_beyond(pixel, ray) && is_pixel;
    const elvis_real stretch = length(ray.direction);
    core_begin_isovalues();

    const core_node root = core_fetch_node(0u);
    const vec3 root_size = max(abs(root.lower), abs(root.upper)), root_sides = root.upper - root.lower;
    const elvis_real far = elvis_real(max(max(max(root_size.x, root_size.y), root_size.z), ray.far));
    core_walk_ray walk_ray;
    walk_ray.origin = ray.origin;
    walk_ray.direction = ray.direction;
    walk_ray.speed = stretch;
    walk_ray.reach = elvis_real(4) * far / stretch;
    // Of the volume, in the ray's parameter.
    const elvis_real size = elvis_real(length(root_sides)) / stretch;
    walk_ray.tolerance = CORE_END_TOLERANCE * size;
    walk_ray.error = ray.error + elvis_real(2) * CORE_ROUNDOFF * far;

    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = is_wanted ? 1u : 0u, work = 0u, phase = CORE_PHASE_SEEK, flags = 0u;
    uint element = 0u, n_parts = 0u;
    core_part part;
    part.element = 0u;
    part.resume = part.last = elvis_real(0);
    // Of the element, of the part, and of the piece.
    elvis_real span_end = elvis_real(0), sought_from = elvis_real(0), curvature = elvis_real(0), bend = CORE_FAR;
    elvis_real part_from = elvis_real(0), part_to = elvis_real(0), from = elvis_real(0), to = elvis_real(0);
    core_piece piece;
    core_follower follower;
    piece.values = piece.slopes = core_segment_begin();
    piece.level = piece.index = 0u;
    core_fit fit = core_segment_fit(piece.values);
    core_polynomial bernstein = fit.chebyshev;
    core_walk walk = core_walk_begin();
    core_candidate candidate = core_candidate(CORE_CROSSING_NONE, 0u, elvis_real(0), elvis_real(0), elvis_real(0));
    elvis_real bracket_from = elvis_real(0), bracket_to = elvis_real(0), isovalue = elvis_real(0), floor_error = elvis_real(0);
    bool rises = false, is_seen_below = false, is_seen_above = false;
    uint polish_turns = 0u;
    elvis_real last_step = CORE_FAR;

    core_nearest nearest = core_nearest_begin(pixel, stretch, along.reference_distance);
    // The nearest place that is undecided.
    elvis_real undecided_t = CORE_FAR;
    uint n_evaluations = 0u, n_certified = 0u, n_verified = 0u, n_undecided = 0u, n_crossings = 0u, n_failures = 0u, n_pieces = 0u;
    uint n_degrees = 0u;

    while ((phase != CORE_PHASE_SEEK || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (phase == CORE_PHASE_SEEK && stack_size > 0u && work < CORE_WORK_LIMIT) {
            work += 1u;
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            vec2 span = core_box_span(node, ray);
            span.x = max(span.x, float(ray.least_t));
            span.y = min(span.y, float(core_nearest_end(nearest)));
            const bool is_touched = span.x <= span.y;
            if (is_touched && !node.is_leaf) {
                const vec2 one = core_box_span(core_fetch_node(node.child), ray), other = core_box_span(core_fetch_node(node.child + 1u), ray);
                const uint nearer = one.x <= other.x ? 0u : 1u;
                stack[stack_size] = node.child + (1u - nearer);
                stack[stack_size + 1u] = node.child + nearer;
                stack_size += 2u;
            }
            if (is_touched && node.is_leaf) {
                element = node.child;
                const core_linearization linearization = core_fetch_linearization(element);
                const vec3 target = vec3(core_reference.xyz - elvis_origin(element) + ray.origin);
                const vec3 start = core_linear_inverse(linearization, target);
                const vec3 motion = core_linear_inverse(linearization, target + vec3(ray.direction)) - start;
                const bool is_linearized = linearization.exponents != 0u;
                curvature = CORE_PART_CURVATURE(element);
                const core_level_model model = core_fetch_level_model(element);
                const vec2 inside = core_linear_span(start, motion, float(curvature), span);
                const vec2 open = core_level_span(model, start, motion, float(curvature), inside);
                const bool is_missed = is_linearized && inside.x > inside.y;
                const bool is_excluded = is_linearized && !is_missed && open.x > open.y;
                n_certified += is_excluded && !model.is_estimated ? 1u : 0u;
                flags |= is_excluded && model.is_estimated ? CORE_FLAG_ESTIMATED : 0u;
#if !CORE_PLAIN
                span = is_linearized ? open : span;
#endif
                bend = elvis_real(2) * elvis_real(model.remainder) / (CORE_EXTENT * CORE_EXTENT);
                span_end = elvis_real(span.y);
                n_parts = 0u;
                const bool is_begun = !is_missed && !is_excluded &&
                                      core_part_begin(walk_ray, element, elvis_real(span.x), min(span_end, elvis_real(span.x) + walk_ray.reach), false, part);
                sought_from = part.begin;
                phase = is_begun ? CORE_PHASE_CLIP : CORE_PHASE_SEEK;
            }
            if (phase != CORE_PHASE_SEEK || stack_size == 0u) {
                break;
            }
        }

        if (phase == CORE_PHASE_CLIP) {
            const uint ending = core_part_turn(walk_ray, true, part);
            n_evaluations += 1u;
            const bool is_found = ending == CORE_PART_FOUND && part.enter < part.leave;
            const bool is_lost = ending != CORE_PART_OPEN && part.has_failed;
            n_failures += is_lost ? 1u : 0u;
            undecided_t = is_lost ? min(undecided_t, part.begin) : undecided_t;
            // A part may have been missed.
            undecided_t = ending == CORE_PART_NONE && part.is_estimated ? min(undecided_t, sought_from) : undecided_t;
            phase = is_found ? CORE_PHASE_SAMPLE : ending == CORE_PART_OPEN ? CORE_PHASE_CLIP : CORE_PHASE_PART_DONE;
            // Ends are as wrong as that, and a crossing beside them is one all the same; but none is behind the eye.
            part_from = max(part.enter - part.enter_error - walk_ray.tolerance, ray.least_t);
            part_to = part.leave + part.leave_error + walk_ray.tolerance;
            piece.level = piece.index = 0u;
            from = part_from;
            to = part_to;
            piece.values = piece.slopes = core_segment_begin();
            follower = core_follow_from(part.anchor, elvis_vec3(part.x, part.y, part.z), elvis_vec3(part.slope_x, part.slope_y, part.slope_z));
            core_follow_to(follower, from);
        }

        if (phase == CORE_PHASE_SOLVE) {
            candidate = core_next_candidate(fit, bernstein, fit.error, walk);
            const bool is_none = candidate.kind == CORE_CROSSING_NONE;
            // Where the polynomial is this near, the field may cross more than once; the slope tells.
            const elvis_real lower_value = core_bernstein_value(bernstein, candidate.lower), upper_value = core_bernstein_value(bernstein, candidate.upper);
            const bool is_doubtful = candidate.kind != CORE_CROSSING_VERIFIED && fit.error > elvis_real(2) * floor_error;
            const bool refines = !is_none && is_doubtful && CORE_PLAIN == 0;
            const bool is_full = piece.values.status != CORE_SEGMENT_WANTS;
            const bool halves = refines && is_full && piece.level < CORE_MOST_LEVELS;
            isovalue = core_isovalues[candidate.index];
            rises = lower_value < upper_value;
            is_seen_below = is_seen_above = false;
            // Beside a piece's end the root of the field may be outside of the bracket.
            const bool is_verified = candidate.kind == CORE_CROSSING_VERIFIED;
            const elvis_real margin = is_verified ? elvis_real(0) : elvis_real(2) * walk_ray.tolerance + elvis_real(1e-6LF) * (to - from);
            bracket_from = from + candidate.lower * (to - from) - margin;
            bracket_to = from + candidate.upper * (to - from) + margin;
            polish_turns = 0u;
            last_step = CORE_FAR;
            core_follow_to(follower, from + candidate.t * (to - from));
            const bool is_ignored = CORE_PLAIN == 1 && candidate.kind == CORE_CROSSING_TOUCH;
            phase = is_none ? CORE_PHASE_PIECE_DONE : is_ignored ? CORE_PHASE_SOLVE : CORE_PHASE_POLISH;
            if (refines && (halves || !is_full)) {
                if (halves) {
                    core_halve(piece);
                    to = elvis_real(0.5LF) * (from + to);
                }
                phase = CORE_PHASE_SAMPLE;
                core_follow_to(follower, from + core_segment_parameter(piece.values) * (to - from));
            }
        }

        core_ray_sample found;
        found.status = CORE_SAMPLE_RUNNING;
        const bool evaluates = phase == CORE_PHASE_SAMPLE || phase == CORE_PHASE_POLISH;
        if (evaluates) {
            found = core_sample_step(walk_ray, element, curvature, follower);
            n_evaluations += 1u;
            const bool is_lost = !found.is_finite || found.status == CORE_SAMPLE_FAILED;
            n_failures += is_lost && found.is_finite ? 1u : 0u;
            flags |= !found.is_finite ? CORE_FLAG_NAN : 0u;
            undecided_t = is_lost && found.is_finite ? min(undecided_t, from) : undecided_t;
            phase = is_lost ? CORE_PHASE_PART_DONE : phase;
        }

        bool is_judged = false;
        if (phase == CORE_PHASE_SAMPLE && found.status == CORE_SAMPLE_FOUND) {
            core_add_sample(piece, found);
            is_judged = piece.values.status != CORE_SEGMENT_WANTS;
            for (int i = 0; i < CORE_SEGMENT_LEVELS; ++i) {
                is_judged = is_judged || piece.values.n_samples == core_segment_counts[i];
            }
            core_follow_to(follower, from + core_segment_parameter(piece.values) * (to - from));
        }
        if (is_judged) {
            fit = core_segment_fit(piece.values);
            bernstein = core_to_bernstein(fit.chebyshev);
            floor_error = CORE_SEGMENT_LEBESGUE * piece.values.sample_error + core_bernstein_rounding(fit.chebyshev);
            const elvis_real least = core_least(bernstein), most = core_most(bernstein);
            const elvis_real slope_error = core_slope_error(piece, bernstein, to - from);
            fit.error += slope_error > CORE_LEAST_SLOPE_ERROR * (most - least) + floor_error ? slope_error : elvis_real(0);
            // What is not rounding is an estimate.
            const elvis_real margin = elvis_real(2) * fit.error;
            const uint first = core_isovalue_from(least - margin);
            const bool is_free = first == core_isovalues_end(first, most + margin);
            const bool is_full = piece.values.status != CORE_SEGMENT_WANTS;
            const bool is_crude = fit.error > elvis_real(0.25LF) * (most - least) + elvis_real(2) * floor_error;
            const bool is_rough = fit.error > CORE_ROUGH * (most - least) + elvis_real(2) * floor_error;
            const bool can_halve = piece.level < CORE_MOST_LEVELS && CORE_PLAIN == 0;
            const bool is_verified = is_free && !is_crude;
            const bool is_solved = !is_verified && (!is_rough || (is_full && !can_halve));
            const bool halves = !is_verified && !is_solved && is_full;
            n_verified += is_verified ? 1u : 0u;
            n_pieces += is_verified || is_solved ? 1u : 0u;
            n_degrees += is_verified || is_solved ? fit.degree : 0u;
#if CORE_PLAIN
            fit.error = core_bernstein_rounding(fit.chebyshev);
#endif
            walk = core_walk_begin();
            phase = is_verified ? CORE_PHASE_PIECE_DONE : is_solved ? CORE_PHASE_SOLVE : phase;
            if (halves) {
                core_halve(piece);
                to = elvis_real(0.5LF) * (from + to);
                core_follow_to(follower, from + core_segment_parameter(piece.values) * (to - from));
            }
        }

        if (phase == CORE_PHASE_POLISH && found.status == CORE_SAMPLE_FOUND) {
            polish_turns += 1u;
            const elvis_real t = follower.at, off = found.value - isovalue;
            const bool is_above = off > found.error, is_below = off < -found.error;
            is_seen_above = is_seen_above || is_above;
            is_seen_below = is_seen_below || is_below;
            bracket_from = (rises ? is_below : is_above) ? max(bracket_from, t) : bracket_from;
            bracket_to = (rises ? is_above : is_below) ? min(bracket_to, t) : bracket_to;
            const elvis_real step = -off / found.slope, half_width = found.error / abs(found.slope);
            const elvis_real speed = core_max_norm(found.w);
            const bool is_regular = core_is_finite(step);
            const elvis_real next = t + step;
            const bool is_within = is_regular && next >= bracket_from && next <= bracket_to;
            // From here the line's root is as good as any.
            const bool is_at_root = is_regular && (abs(step) * speed <= elvis_real(4) * found.rounding ||
                                                   // Steps are rounding of the field.
                                                   (abs(step) <= half_width && abs(step) >= elvis_real(0.5LF) * last_step));
            last_step = is_regular ? abs(step) : CORE_FAR;
            const bool is_narrow = bracket_to - bracket_from <= elvis_real(4) * CORE_ROUNDOFF * max(abs(bracket_from), abs(bracket_to));
            const bool is_candidate = candidate.kind != CORE_CROSSING_VERIFIED;
            const bool is_last = polish_turns >= (is_candidate ? CORE_CANDIDATE_TURNS : CORE_POLISH_TURNS);
            const bool is_settled = is_at_root || is_narrow || CORE_PLAIN == 1;
            const elvis_real root_t = is_at_root && CORE_PLAIN == 0 ? next : t;

            const elvis_real bend_here = bend + elvis_real(2) * curvature * core_model_norm1(found.gradient);
            const elvis_real radius = core_max_norm(found.q) + found.beyond + speed * (half_width + abs(step));
            const bool keeps_slope = found.is_known && speed * bend_here * radius < abs(found.slope);
            const bool is_confirmed = !is_candidate || keeps_slope || (is_seen_below && is_seen_above) || CORE_PLAIN == 1;
            const elvis_real slack = walk_ray.tolerance + elvis_real(0.25LF) * half_width;
            const elvis_real outside = max(part_from - root_t, root_t - part_to);
            const bool is_inside = outside <= slack;
            const bool is_surely_inside = root_t >= part.enter + part.enter_error + slack && root_t <= part.leave - part.leave_error - slack;
            const bool is_behind_start = root_t > ray.least_t + ray.widths_behind * half_width && root_t > ray.least_t;
            const bool is_hit = is_settled && is_confirmed && is_inside && is_behind_start;
            // The last step may be small by chance.
            const elvis_real blur = max(abs(step), CORE_BLUR_SHARE * half_width);
            const bool is_wide = CORE_PLAIN == 0 && blur > CORE_DEPTH_TOLERANCE * size, is_blurred = is_hit && is_wide;
            // What rounding alone may have led out of the part may be in it.
            const bool is_led_out = is_wide && !is_inside && outside <= half_width;
            const bool is_undecided = !is_hit && (is_settled ? !is_confirmed || is_led_out : is_last);
            n_crossings += is_settled && is_confirmed ? 1u : 0u;
            n_undecided += is_undecided ? 1u : 0u;
            undecided_t = is_undecided ? min(undecided_t, from + candidate.t * (to - from)) : is_blurred ? min(undecided_t, root_t) : undecided_t;

            const elvis_vec3 gradient = found.gradient.x * found.frame.row0 + found.gradient.y * found.frame.row1 + found.gradient.z * found.frame.row2;
            const elvis_vec3 point = found.xi + found.q + (root_t - t) * found.w;
            const elvis_real inverse_square = dot(found.frame.row0, found.frame.row0) + dot(found.frame.row1, found.frame.row1) + dot(found.frame.row2, found.frame.row2);
            core_nearest_take(is_hit,
                              core_nearest(root_t, half_width, point.x, point.y, point.z, isovalue, gradient.x, gradient.y, gradient.z,
                                           inverse_square * bend_here / length(gradient), element, elvis_fetch_core_elements(element, 0u),
                                           is_surely_inside),
                              nearest);
            const bool is_estimated = core_is_model_estimated(element) || part.is_estimated || CORE_PLAIN == 1;
            flags |= is_hit && is_estimated ? CORE_FLAG_ESTIMATED : 0u;

            phase = is_hit ? CORE_PHASE_SEEK : is_settled || is_last ? CORE_PHASE_SOLVE : CORE_PHASE_POLISH;
            core_follow_to(follower, is_within ? next : elvis_real(0.5LF) * (bracket_from + bracket_to));
        }

        if (phase == CORE_PHASE_PIECE_DONE) {
            const bool is_last = core_is_last_piece(piece);
            if (!is_last) {
                core_next_piece(piece);
                from = to;
                to = part_from + (elvis_real(piece.index + 1u) / elvis_real(1u << piece.level)) * (part_to - part_from);
                core_follow_to(follower, from + core_segment_parameter(piece.values) * (to - from));
            }
            phase = is_last ? CORE_PHASE_PART_DONE : from > core_nearest_end(nearest) ? CORE_PHASE_SEEK : CORE_PHASE_SAMPLE;
        }
        if (phase == CORE_PHASE_PART_DONE) {
            n_parts += 1u;
            const elvis_real resume = part.resume + walk_ray.tolerance;
            const bool goes_on = part.is_inside && resume < span_end && resume < core_nearest_end(nearest);
            undecided_t = goes_on && n_parts >= CORE_MOST_PARTS ? min(undecided_t, resume) : undecided_t;
            bool is_begun = false;
            if (goes_on && n_parts < CORE_MOST_PARTS) {
                is_begun = core_part_begin(walk_ray, element, resume, span_end, false, part);
                sought_from = part.begin;
            }
            phase = is_begun ? CORE_PHASE_CLIP : CORE_PHASE_SEEK;
        }
        if (phase == CORE_PHASE_SEEK && stack_size == 0u) {
            break;
        }
    }

    const bool is_cut_short = is_pixel && (phase != CORE_PHASE_SEEK || stack_size > 0u || core_has_driver_given_up(core_surface >> 31));
    flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT | CORE_FLAG_ISOSURFACE_UNDECIDED : 0u;
    flags |= undecided_t <= core_nearest_end(nearest) && undecided_t < CORE_FAR ? CORE_FLAG_ISOSURFACE_UNDECIDED : 0u;
    flags |= core_nearest_store(nearest, pixel, ray, stretch, along.reference_distance);
    if (is_pixel && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations), all_certified = subgroupAdd(n_certified), all_verified = subgroupAdd(n_verified);
    const uint all_undecided = subgroupAdd(n_undecided), all_crossings = subgroupAdd(n_crossings), all_failures = subgroupAdd(n_failures);
    const uint all_pieces = subgroupAdd(n_pieces), all_degrees = subgroupAdd(n_degrees);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
        atomicAdd(core_counts[1], all_certified);
        atomicAdd(core_counts[2], all_verified);
        atomicAdd(core_counts[3], all_undecided);
        atomicAdd(core_counts[4], all_crossings);
        atomicAdd(core_counts[5], all_failures);
        atomicAdd(core_counts[6], all_pieces);
        atomicAdd(core_counts[7], all_degrees);
    }
}
