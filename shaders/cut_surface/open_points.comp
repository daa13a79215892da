// Points of a cut surface that may lie in an element which the search (cut_surface/locate.glsl) has dismissed without a bound: they are
// looked for in octants so small that the mapping in each is nearly linear. What is left in the end makes the pixel undecided, unless the
// point is found elsewhere.
//
// An invocation is a pixel of the list.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"
#include "picture/view.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
#include "cut_surface/point_parameters.glsl"

#define CORE_OPEN_POINTS_BINDING 4
#include "cut_surface/open_points.glsl"
#if !CORE_ON_PLANE
#include "cut_surface/hit_point.glsl"
layout(set = 0, binding = 7, std430) readonly buffer core_hits_block { core_hit_record core_hits[]; };
// Written if core_wants_places.
layout(set = 0, binding = 8, std430) writeonly buffer core_places_block { core_place core_places[]; };
#endif

#include "arithmetic/count.glsl"
#include "picture/show.glsl"
#include "cut_surface/element_candidate.glsl"
#include "cut_surface/listed_point.glsl"
#include "cut_surface/octant_roots.glsl"
#include "cut_surface/octant_location.glsl"

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_listed = i < core_n_open_points;
    const core_open_point open = core_open_points[is_listed ? i : core_first];
    const uint pixel = open.pixel;
    const core_cut_point point = core_point_of(pixel);
    const bool is_wanted = is_listed && core_is_wanted(pixel, point);
    const vec3 in_hierarchy = vec3(point.position + core_reference_in_hierarchy.xyz);
    const float box_tolerance = core_box_tolerance(point, in_hierarchy);
    core_octant_search search = core_octants_around(open, point, in_hierarchy, box_tolerance, is_wanted);
    const core_location found = core_locate_in_octants(point, in_hierarchy, box_tolerance, search);
    const bool has_found = found.element != CORE_NO_ELEMENT;
    elvis_real value = elvis_real(0);
    if (has_found) {
        value = core_shown_value(found.element, elvis_vec3(found.x, found.y, found.z));
    }
    const bool is_cut_short = found.is_cut_short || core_has_driver_given_up(core_size.x >> 31);
    // Where octants are still missing the search is done again.
    const bool is_done = is_wanted && !search.has_asked;
    uint n_evaluations = 0u;
    if (is_done && (has_found || is_cut_short)) {
        n_evaluations = core_merge(pixel, point, found, value);
#if !CORE_ON_PLANE
        if (n_evaluations > 0u && core_wants_places != 0u) {
            core_places[pixel] = core_place(found.x, found.y, found.z, found.element, CORE_CLASS << CORE_PLACE_FACE_BITS);
        }
#endif
    }
    if (is_done && !has_found && (search.is_undecided || is_cut_short)) {
        core_marks[pixel].flags |= CORE_FLAG_UNDECIDED_IN_FRONT;
    }
    core_count(0u, n_evaluations);
    core_count(1u, found.n_steps);
#if !CORE_ON_PLANE
    core_count(3u, n_evaluations > 0u ? 1u : 0u);
#endif
}
