// The first point of the ray of each listed pixel at which the field takes one of the isovalues, in the elements of one class, by
// projection of the field along the ray (Nelson & Kirby, Ray-tracing polymorphic multidomain spectral/hp elements for isosurface
// rendering, 2006).
//
// Elements whose range holds an isovalue are visited nearest first, and in each the segments, from exact entry to
// exact exit (segments/segment.glsl). Samples of the field along a segment become a polynomial (segments/fit.glsl). Its degree is raised,
// and then the segment is halved, until the error E is small beside how much the polynomial varies. Samples have the field's slope along
// the ray, too, and the polynomial must have the same: few values alone can deceive. An interval is left out if no isovalue lies within E
// of the polynomial's Bernstein coefficients: that is verified, not certified. Else the polynomial's crossings are looked at in order.
// Each is polished on the field itself by Newton's method along the ray; it is taken if
//
//     E shows that the field crosses in the bracket in which the root was found    or
//     the field is seen on both sides, or surely keeps its slope within what rounding moves the root.
//
// (isosurface/projection_segment.glsl, projection_interval.glsl and projection_polish.glsl.)
//
// Where neither holds the interval is halved as long as E is more than rounding; then the pixel is undecided.
//
// With CORE_PLAIN the method is that of 2006: each segment as one polynomial of fixed degree, whose first root is the answer.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "element/place.glsl"
#include "arithmetic/finite.glsl"
#include "picture/pixel_ray.glsl"
#define CORE_LAST_BINDING 10
#include "isosurface/isosurface_bindings.glsl"
#include "isosurface/isosurface_blur.glsl"
#include "arithmetic/count.glsl"

layout(set = 0, binding = 5) CORE_READ_WORDS(core_list);
layout(push_constant) uniform core_parameters {
    uint core_width;
    // Of the list.
    uint core_first, core_end;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_n_clips;
    uint core_has_beyond;
    // 0: from the eye on.
    uint core_round;
    // The diagonal of the volume's bounds.
    float core_extent;
};

#include "isosurface/isovalues.glsl"
elvis_real core_listed_value(uint i) { return CORE_REAL(core_isovalues, i); }

#define CORE_CENTRE core_reference.xyz
#define CORE_SEGMENT_CURVATURE(element) elvis_real(elvis_fetch_core_curvatures(element, 0u))

#include "picture/look_beyond.glsl"
#include "arithmetic/driver_limit.glsl"
#include "field/shown_model.glsl"
// Of elements that are curved more than usual a segment that is missed would be a crossing missed.
#define CORE_ASSUMED_CURVATURE elvis_real(16)
#define CORE_CERTAIN_ITERATIONS 96u
#define CORE_SEGMENT_ITERATIONS 160u
#include "segments/segment.glsl"
#include "segments/ray_sample.glsl"
#include "field/linear_model.glsl"
#include "isosurface/value_span.glsl"
#include "segments/polynomial.glsl"
#include "segments/colleague.glsl"

// Iterations of a pixel, with all loops inside below where drivers end them.
#define CORE_WORK_LIMIT 8000u

// Times that a segment may be halved. A field that is smooth needs few; that its derivatives jump is seen at the last.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_MOST_LEVELS 14u
#else
#define CORE_MOST_LEVELS 8u
#endif

#include "isosurface/nearest_crossing.glsl"
#include "isosurface/kept_part.glsl"
#include "segments/root_candidate.glsl"
#include "segments/dyadic_interval.glsl"
#include "isosurface/projection_search.glsl"
#include "isosurface/projection_segment.glsl"
#include "isosurface/projection_interval.glsl"
#include "isosurface/projection_polish.glsl"

// Nodes of the hierarchy that wait.
uint core_stack[CORE_STACK_SIZE];

core_traced_ray core_projection_ray(core_ray ray, elvis_real stretch, out elvis_real size) {
    const core_node root = core_fetch_node(0u);
    const vec3 root_size = max(abs(root.lower), abs(root.upper));
    const elvis_real far = elvis_real(max(max(max(root_size.x, root_size.y), root_size.z), ray.far));
    // Of all of the volume, whatever part of it can hold an isovalue.
    size = elvis_real(core_extent) / stretch;
    core_traced_ray traced_ray;
    traced_ray.origin = ray.origin;
    traced_ray.direction = ray.direction;
    traced_ray.speed = stretch;
    traced_ray.longest = elvis_real(4) * far / stretch;
    traced_ray.tolerance = CORE_END_TOLERANCE * size;
    traced_ray.error = ray.error + elvis_real(2) * CORE_ROUNDOFF * far;
    return traced_ray;
}

// To the next node: the search begins in its element, or its children wait, the nearer one before the other. `nearest_end`: nothing need
// be looked at behind.
void core_projection_next_node(core_ray ray, core_traced_ray traced_ray, elvis_real nearest_end, inout uint stack_size,
                               inout core_projection_search search) {
    stack_size -= 1u;
    const core_node node = core_fetch_node(core_stack[stack_size]);
    vec2 span = core_box_span(node, ray);
    span.x = max(span.x, float(ray.least_t));
    span.y = min(span.y, float(nearest_end));
    const bool is_met = span.x <= span.y;
    if (is_met && !node.is_leaf) {
        const vec2 one = core_box_span(core_fetch_node(node.child), ray), other = core_box_span(core_fetch_node(node.child + 1u), ray);
        const uint nearer = one.x <= other.x ? 0u : 1u;
        core_stack[stack_size] = node.child + (1u - nearer);
        core_stack[stack_size + 1u] = node.child + nearer;
        stack_size += 2u;
    }
    if (is_met && node.is_leaf) {
        core_projection_element(ray, traced_ray, node.child, span, search);
    }
}

// The step that the search's phase asks for, and those that follow from it without a further sample. `size`: of the volume, in the
// ray's parameter.
void core_projection_step(core_ray ray, core_traced_ray traced_ray, elvis_real size, const core_last_crossing last,
                          inout core_projection_search search, inout core_nearest_crossing nearest) {
    if (search.phase == CORE_PHASE_CLIP) {
        core_projection_segment(ray, traced_ray, search);
    }
    if (search.phase == CORE_PHASE_SOLVE) {
        core_projection_solve(traced_ray, search);
    }
    core_ray_sample found;
    found.status = CORE_SAMPLE_RUNNING;
    if (search.phase == CORE_PHASE_SAMPLE || search.phase == CORE_PHASE_POLISH) {
        found = core_projection_sample(traced_ray, search);
    }
    bool is_judged = false;
    if (search.phase == CORE_PHASE_SAMPLE && found.status == CORE_SAMPLE_FOUND) {
        is_judged = core_projection_add(found, search);
    }
    if (is_judged) {
        core_projection_judge(search);
    }
    if (search.phase == CORE_PHASE_POLISH && found.status == CORE_SAMPLE_FOUND) {
        core_projection_polish_or_take(ray, traced_ray, size, last, found, search, nearest);
    }
    if (search.phase == CORE_PHASE_INTERVAL_DONE) {
        core_projection_behind_interval(core_nearest_end(nearest), search);
    }
    if (search.phase == CORE_PHASE_SEGMENT_DONE) {
        core_projection_behind_segment(traced_ray, core_nearest_end(nearest), search);
    }
}

void core_count_projection(core_projection_search search) {
    core_count(0u, search.n_evaluations);
    core_count(1u, search.n_certified);
    core_count(2u, search.n_verified);
    core_count(3u, search.n_undecided);
    core_count(4u, search.n_crossings);
    core_count(5u, search.n_failures);
    core_count(6u, search.n_intervals);
    core_count(7u, search.n_degrees);
}

void main() {
    const uint place = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = place < core_end;
    const uint pixel = is_pixel ? CORE_WORD(core_list, place) : 0u;
    const core_cut_column along = core_cut_begin(elvis_real(pixel % core_width));
    core_ray ray = core_pixel_ray(along, elvis_real(pixel / core_width));
    const bool is_looked_for = core_look_beyond(pixel, ray) && is_pixel;
    const elvis_real stretch = length(ray.direction);
    const core_last_crossing last = core_last_crossing_of(pixel, ray.least_t);
    core_nearest_crossing nearest = core_nearest_begin(pixel, stretch, along.reference_distance);
    const bool is_wanted = core_keep_part(ray, nearest) && is_looked_for;
    core_begin_isovalues();
    elvis_real size;
    const core_traced_ray traced_ray = core_projection_ray(ray, stretch, size);

    core_stack[0] = 0u;
    uint stack_size = is_wanted ? 1u : 0u, work = 0u;
    core_projection_search search = core_projection_begin();
    while ((search.phase != CORE_PHASE_SEEK || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (search.phase == CORE_PHASE_SEEK && stack_size > 0u && work < CORE_WORK_LIMIT) {
            work += 1u;
            core_projection_next_node(ray, traced_ray, core_nearest_end(nearest), stack_size, search);
            if (search.phase != CORE_PHASE_SEEK || stack_size == 0u) {
                break;
            }
        }
        core_projection_step(ray, traced_ray, size, last, search, nearest);
        if (search.phase == CORE_PHASE_SEEK && stack_size == 0u) {
            break;
        }
    }

    const bool is_over = search.phase == CORE_PHASE_SEEK && stack_size == 0u;
    const bool is_cut_short = is_pixel && (!is_over || core_has_driver_given_up(core_surface_number >> 31));
    const bool is_undecided = search.undecided_t <= core_nearest_end(nearest) && search.undecided_t < CORE_FAR;
    search.flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
    search.flags |= is_cut_short || is_undecided ? CORE_FLAG_ISOSURFACE_UNDECIDED : 0u;
    search.flags |= core_nearest_store(nearest, pixel, ray, stretch, along.reference_distance);
    if (is_pixel && search.flags != 0u) {
        core_marks[pixel].flags |= search.flags;
    }
    core_count_projection(search);
}
