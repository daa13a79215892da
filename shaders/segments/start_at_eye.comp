// Rays whose eye lies in an element begin their walk there (segments/walk_state.glsl); for the elements of one class.
//
// Where the eye lies in a face, an edge or a corner within rounding, the ray goes into those of the elements around it from which it does
// not leave by one of these faces. Where it runs along a face, which rounding does not tell, it is taken to go into the elements on both
// sides. So at least one is found, and the walk finds out what it leaves at once. The lowest one counts.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "picture/samples.glsl"
#include "arithmetic/precision.glsl"
#if CORE_MAKES_SEGMENTS
#include "segments/segment_state.glsl"
#define CORE_STATE core_segment_state
#else
#include "volume/volume_state.glsl"
#define CORE_STATE core_volume_state
#endif

layout(set = 0, binding = 1, std430) buffer core_states_block { CORE_STATE core_states[]; };
// Evaluations; rays with their eye in several elements.
layout(set = 0, binding = 2, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    // In the list of groups; not read where rays are given.
    uint core_first_group;
    // Among all elements of the volume.
    uint core_first_element;
    uint core_zero;
    // The diagonal of the volume's bounds; what its positions are off before any of it is evaluated.
    float core_extent, core_data_error;
};

#if CORE_RAYS_ARE_GIVEN
#define CORE_RAYS_BINDING 3
#else
#define CORE_GROUPS_BINDING 3
#include "tiles/listed_group.glsl"
#endif
#include "segments/source_ray.glsl"
#include "arithmetic/driver_limit.glsl"
#include "segments/segment.glsl"
#include "segments/point_search.glsl"
#include "arithmetic/count.glsl"

// Nodes and evaluations of a ray, with all loops inside below where drivers end them.
#define CORE_WORK_LIMIT 2500u

// Nodes of the hierarchy that are still to be looked at.
uint core_stack[CORE_STACK_SIZE];

// Of the elements looked at so far.
struct core_eye {
    // Without bounds of the mapping, elements that do not hold it are estimated.
    bool is_undecided, is_estimated;
    // The lowest one that the ray goes into, and those that hold the eye away from their faces.
    uint element, n_around;
    uint stack_size, work, n_evaluations;
};

// Whether the ray's point lies in a face within rounding, and whether the ray surely leaves there.
struct core_eye_side {
    bool is_in_face, leaves;
};

core_eye_side core_side_of_eye(const core_point_search found, elvis_real value, elvis_real rate, elvis_real noise) {
    // Over the length of the shape. Elements on both sides of a face must not both tell that the ray leaves.
    const elvis_real change = rate / max(core_max_norm(core_slope_of(found.at)), elvis_real(1e-30LF));
    const bool is_in_face = value > -noise;
    return core_eye_side(is_in_face, is_in_face && change > elvis_real(2) * noise);
}

void core_take_eye(uint element, const core_point_search found, inout core_eye eye) {
    const elvis_vec3 at = core_xi_of(found.at), slope = core_slope_of(found.at);
    bool is_around = found.status == CORE_POINT_FOUND, goes_in = is_around;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const core_eye_side side = core_side_of_eye(found, dot(constraint.xyz, at) + constraint.w, dot(constraint.xyz, slope),
                                                  dot(abs(constraint.xyz), elvis_vec3(found.noise)));
        is_around = is_around && !side.is_in_face;
        goes_in = goes_in && !side.leaves;
    }
#if ELVIS_HAS_INSIDE
    const core_inside g = core_inside_at(element, at);
    const elvis_real noise = dot(abs(g.slope), elvis_vec3(found.noise)) + g.rounding;
    const core_eye_side side = core_side_of_eye(found, g.value, dot(g.slope, slope), noise);
    is_around = is_around && !side.is_in_face;
    goes_in = goes_in && g.value <= noise && !side.leaves;
#endif
    eye.element = goes_in ? min(eye.element, element) : eye.element;
    eye.n_around += is_around ? 1u : 0u;
    eye.is_undecided = eye.is_undecided || found.status == CORE_POINT_UNDECIDED;
    eye.is_estimated = eye.is_estimated || (found.status == CORE_POINT_OUTSIDE && found.is_estimated);
    eye.n_evaluations += found.n_evaluations;
    eye.work += found.n_evaluations;
}

// The next element whose box holds the point; CORE_NO_ELEMENT if there is none.
uint core_next_element(vec3 point, float tolerance, inout core_eye eye) {
    uint element = CORE_NO_ELEMENT;
    while (element == CORE_NO_ELEMENT && eye.stack_size > 0u) {
        eye.work += 1u;
        eye.stack_size -= 1u;
        const core_node node = core_fetch_node(core_stack[eye.stack_size]);
        const bool is_touched = core_contains(node, point, tolerance);
        element = is_touched && node.is_leaf ? node.child : CORE_NO_ELEMENT;
        if (is_touched && !node.is_leaf) {
            core_stack[eye.stack_size] = node.child + 1u;
            core_stack[eye.stack_size + 1u] = node.child;
            eye.stack_size += 2u;
        }
        if (element != CORE_NO_ELEMENT || eye.stack_size == 0u) {
            break;
        }
    }
    return element;
}

void main() {
#if CORE_RAYS_ARE_GIVEN
    const uvec2 place = uvec2(gl_GlobalInvocationID.x, 0u);
#else
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
#endif
    const bool is_pixel = place.x < core_size.x && place.y < core_size.y;
    const uint pixel = is_pixel ? place.y * core_size.x + place.x : 0u;
    core_walk_state walk = core_states[pixel].walk;
    const bool is_mine = is_pixel && walk.status == CORE_RAY_SEEKS;
    const core_ray pixel_ray = core_source_ray(place.x, place.y, pixel);
    const core_traced_ray ray = core_traced_ray_of(pixel_ray, elvis_real(core_extent), elvis_real(core_data_error));
    const elvis_real t = pixel_ray.least_t;
    const elvis_vec3 way = t * pixel_ray.direction;
    const vec3 point = pixel_ray.box_origin + vec3(way);
    const float tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * (pixel_ray.far + float(core_max_norm(way)));
    core_eye eye = core_eye(false, false, CORE_NO_ELEMENT, 0u, is_mine ? 1u : 0u, 0u, 0u);
    core_stack[0] = 0u;
    while (eye.stack_size > 0u && eye.work < CORE_WORK_LIMIT) {
        const uint element = core_next_element(point, tolerance, eye);
        if (element != CORE_NO_ELEMENT) {
            core_take_eye(element, core_search_point(ray, element, t), eye);
        }
        if (eye.stack_size == 0u) {
            break;
        }
    }
    if (is_mine) {
        const bool is_found = eye.element != CORE_NO_ELEMENT;
        const bool is_cut_short = eye.stack_size > 0u || core_has_driver_given_up(core_zero);
        // Another class may have left open what this one tells.
        walk.flags = is_found ? 0u : walk.flags;
        walk.flags |= eye.n_around > 1u || (eye.is_undecided && !is_found) ? CORE_FLAG_UNDECIDED : 0u;
        walk.flags |= eye.is_estimated && !is_found ? CORE_FLAG_ESTIMATED : 0u;
        walk.flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
        if (is_found) {
            walk.at = walk.start = t;
            walk.global_element = walk.global_start_element = core_first_element + eye.element;
            walk.status = CORE_RAY_GOES;
        }
        core_states[pixel].walk = walk;
    }
    core_count(0u, eye.n_evaluations);
    core_count(1u, eye.n_around > 1u ? 1u : 0u);
}
