// The interval that a ray's search in an octant looks at, and what one evaluation tells of it.
//
// The kernel brings isosurface/ray_interval.glsl and isosurface/nearest_crossing.glsl.

#include "field/leaf_bounds.glsl"

// Offsets from xi, in reference coordinates, below which rounding counts more than what the linearization leaves out.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NARROW elvis_real(6e-8LF)
#else
#define CORE_NARROW elvis_real(2e-3LF)
#endif
// Intervals are not made shorter than this share of that where rounding does count more; and nowhere shorter than so many times what it
// makes of reference coordinates.
#define CORE_FLOOR elvis_real(0.25LF)
#define CORE_FLOOR_ROUNDINGS elvis_real(4)

#define CORE_NO_CODE 0xffffffffu

struct core_interval_search {
    // CORE_NO_ELEMENT: nothing is looked at.
    uint element;
    // The interval; where the one after it begins, and where the octant ends.
    elvis_real from, to, next, last;
    // The field is bounded at least this far to both sides of the interval's middle: more than the interval is long where the field is so
    // flat that rounding moves the candidate farther.
    elvis_real wide;
    // Half the length of the shortest intervals, in reference coordinates.
    elvis_real shortest;
    // Where the mapping is linearized.
    elvis_real x, y, z;
    // Of the mapping in the octant.
    elvis_real curvature;
    // Of an octant in which a prediction may be another point's, or where that is asked of forms; else CORE_NO_CODE.
    uint bent_code;
    // Bound of the field's second derivatives, from the last interval that was long enough for it.
    elvis_real bend;
    // Evaluations in the octant; those of them that linearized the mapping anew for the same interval.
    uint used, moves;
};

core_interval_search core_no_search() {
    const elvis_real zero = elvis_real(0);
    return core_interval_search(CORE_NO_ELEMENT, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, CORE_NO_CODE, CORE_FAR, 0u,
                                0u);
}

struct core_evaluation {
    // The search's element, or any where it has none.
    uint element;
    elvis_vec3 xi;
    core_frame frame;
    // Of the interval: where the parameter s is zero, half its length, and how far to both sides of that the field is bounded.
    elvis_real middle, half_width, reach;
    // The shortest half length of an interval.
    elvis_real shortest;
    // Change of reference coordinates along the ray, in the maximum norm.
    elvis_real speed;
    core_ray_interval interval;
    // Of the field's model: its slope in reference coordinates.
    elvis_vec3 slope;
    core_linear_root candidate;
    // Bound of the field's second derivatives along curves that are straight in the world: the mapping's own bending counts, too.
    elvis_real bend;
    // By this much at most the field's slope along the ray differs from the interval's slope.
    elvis_real turn;
    bool is_finite;
#if ELVIS_HAS_INSIDE
    core_inside own;
#endif
};

// From here on the remainder of a model tells second derivatives, not rounding. In pyramids these grow towards the apex, and a bound from
// elsewhere does not hold: each interval has its own, rounding and all.
#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#define CORE_WIDE_ENOUGH elvis_real(0)
#else
#define CORE_WIDE_ENOUGH (elvis_real(8) * CORE_NARROW)
#endif

// A second solution of a prediction need not lie outside of the octant (isosurface/octant_mapping.glsl): how far the octant's points are
// from xi counts.
core_interval_bend core_interval_bend_at(const core_interval_search search, uint element, elvis_vec3 xi, const core_frame frame) {
    const bool is_asked = search.bent_code != CORE_NO_CODE;
    const uint code = is_asked ? search.bent_code : 0u;
    const elvis_vec3 to_middle = elvis_vec3(core_octant_middle(code)) - xi;
    const elvis_real half_side = elvis_real(core_octant_half_side(code));
    core_interval_bend bend;
    bend.curvature = search.curvature;
    bend.farthest = is_asked ? min(core_max_norm(to_middle) + half_side, elvis_real(2)) : elvis_real(0);
#if CORE_HAS_BEND_FORMS
    bend.local = core_local_bend_at(element, frame);
    bend.farthest_length = core_bend_length(bend.local, to_middle) + half_side * core_bend_length_of_cube(bend.local);
#endif
    return bend;
}

// How much the field's slope along the ray changes within the interval's radius.
elvis_real core_turn_of(const core_evaluation evaluation, const core_interval_bend bend, elvis_real field_bend) {
    const core_ray_interval interval = evaluation.interval;
    elvis_real turn = evaluation.speed * evaluation.bend * interval.radius;
#if CORE_HAS_BEND_FORMS
    // With d(s) and its derivative d', N(d') <= N(w) + 2 C N(d) N(d'), and d' differs from w by J^-1 D^2x(d, d').
    const elvis_real room = elvis_real(1) - elvis_real(2) * bend.local.curvature * interval.bend_length;
    const elvis_real product = interval.bend_length * core_bend_length(bend.local, interval.w) / room;
    const elvis_real distance = sqrt(elvis_real(2) * product);
    const elvis_real by_forms = field_bend * interval.radius * (evaluation.speed + core_bend_error(bend.local, distance)) +
                                core_bend_value_error(bend.local, core_to_world(evaluation.frame, evaluation.slope), distance);
    turn = bend.local.is_known && room > elvis_real(0) ? min(turn, by_forms) : turn;
#endif
    return turn;
}

core_evaluation core_evaluate_at(const core_ray ray, inout core_interval_search search) {
    core_evaluation evaluation;
    evaluation.element = search.element != CORE_NO_ELEMENT ? search.element : 0u;
    evaluation.xi = elvis_vec3(search.x, search.y, search.z);
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(evaluation.element, evaluation.xi, position, jacobian);
    const elvis_vec3 shift = core_reference.xyz - elvis_origin(evaluation.element);
    evaluation.middle = elvis_real(0.5LF) * (search.from + search.to);
    const elvis_vec3 step = evaluation.middle * ray.direction;
    const elvis_real error = ray.error + elvis_real(2) * CORE_ROUNDOFF * (core_max_norm(shift) + core_max_norm(step));
    evaluation.frame = core_frame_at(position, jacobian, error);
    evaluation.speed = core_max_norm(core_to_xi(evaluation.frame, ray.direction));
    evaluation.shortest = search.shortest / evaluation.speed;
    evaluation.half_width = elvis_real(0.5LF) * (search.to - search.from);
    evaluation.reach = max(max(evaluation.half_width, evaluation.shortest), search.wide);
    const core_interval_bend bend = core_interval_bend_at(search, evaluation.element, evaluation.xi, evaluation.frame);
    evaluation.interval = core_interval_in_element(evaluation.xi, evaluation.frame, ((shift - position) + ray.origin) + step, ray.direction,
                                                   evaluation.reach, bend);
#if ELVIS_HAS_INSIDE
    evaluation.own = core_inside_at(evaluation.element, evaluation.xi);
    core_cut_interval_inside(evaluation.own, evaluation.interval);
#endif
    core_model model;
    elvis_real value;
    core_interval_take_field(evaluation.interval, evaluation.element, evaluation.xi, evaluation.frame, bend, model, value);
    evaluation.slope = model.slope;
    evaluation.candidate = core_first_linear_root(evaluation.interval);
    const elvis_real radius = evaluation.interval.radius;
    search.bend = !core_is_away_from_apex(evaluation.xi, radius) ? CORE_FAR
                  : radius > CORE_WIDE_ENOUGH                     ? elvis_real(2) * model.remainder / (radius * radius)
                                                                  : search.bend;
    evaluation.bend = search.bend + elvis_real(2) * search.curvature * core_model_norm1(model.slope);
    evaluation.turn = core_turn_of(evaluation, bend, search.bend);
    evaluation.is_finite = core_is_finite(value + core_max_norm(position));
    return evaluation;
}
