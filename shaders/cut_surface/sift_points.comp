// Of the points that may lie in elements which the search has dismissed (cut_surface/open_points.glsl), lists those that linear models of
// octants do not rule out: a tenth as a rule. Only these are worth Newton's method, which all lanes would wait for
// (cut_surface/open_points.comp).
//
// An invocation is a pixel of the list.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"
#include "picture/view.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
#include "cut_surface/point_parameters.glsl"

#define CORE_OPEN_POINTS_BINDING 4
#include "cut_surface/open_points.glsl"
layout(set = 0, binding = 3, std430) buffer core_sifted_block {
    uint core_n_sifted;
    core_open_point core_sifted[];
};
#if !CORE_ON_PLANE
#include "cut_surface/hit_point.glsl"
layout(set = 0, binding = 7, std430) readonly buffer core_hits_block { core_hit_record core_hits[]; };
#endif

#include "picture/show.glsl"
#include "cut_surface/element_candidate.glsl"
#include "cut_surface/listed_point.glsl"
#include "cut_surface/octant_roots.glsl"
#include "isosurface/octant.glsl"
#include "cut_surface/octant_descent.glsl"

bool core_may_be_in_octants(core_cut_point point, vec3 in_hierarchy, float box_tolerance, inout core_octant_search search) {
    bool may_be = false;
    while (search.stack_size > 0u && !may_be && search.work < CORE_WORK_LIMIT) {
        const uint octant = core_next_octant(in_hierarchy, box_tolerance, search);
        may_be = octant != CORE_NO_OCTANT &&
                 core_guess_in(core_fetch_octant(octant != CORE_NO_OCTANT ? octant : 0u), point, in_hierarchy).may_hold;
        if (may_be || search.stack_size == 0u || search.work >= CORE_WORK_LIMIT) {
            break;
        }
    }
    return may_be || search.stack_size > 0u;
}

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_listed = i < core_n_open_points;
    const core_open_point open = core_open_points[is_listed ? i : core_first];
    const core_cut_point point = core_point_of(open.pixel);
    const bool is_wanted = is_listed && core_is_wanted(open.pixel, point);
    const vec3 in_hierarchy = vec3(point.position + core_reference_in_hierarchy.xyz);
    const float box_tolerance = core_box_tolerance(point, in_hierarchy);
    core_octant_search search = core_octants_around(open, point, in_hierarchy, box_tolerance, is_wanted);
    const bool may_be = core_may_be_in_octants(point, in_hierarchy, box_tolerance, search);
    // Where octants are still missing it is done again.
    if (is_wanted && !search.has_asked && (may_be || search.is_undecided || search.is_cut_short)) {
        core_sifted[atomicAdd(core_n_sifted, 1u)] = open;
    }
}
