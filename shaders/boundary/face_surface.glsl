// Bindings of the kernels that draw faces, and how the nearest crossing gets into the picture.

#include "arithmetic/read_only.glsl"
#include "element/place.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
// Three numbers a pixel.
layout(set = 0, binding = 2, std430) writeonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5) CORE_READ_WORDS(core_tiles);
// Pixels that boundary/faces.comp leaves to boundary/faces_careful.comp; core_counts[3] of them.
layout(set = 0, binding = 6, std430) buffer core_list_block { uint core_list[]; };
// Depths behind which crossings are wanted; CORE_FAR where none is. Read if core_has_beyond.
layout(set = 0, binding = 7) CORE_READ_REALS(core_beyond);
// Written if core_wants_places.
layout(set = 0, binding = 8, std430) writeonly buffer core_places_block { core_place core_places[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_tiles_per_row;
    // Where in the list of tiles, or of pixels, the dispatch begins.
    uint core_first;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    uint core_first_component;
    uint core_end_component;
    // Two values on an edge.
    uint core_is_discontinuous;
    float core_value_tolerance;
    uint core_has_beyond;
    uint core_wants_normals;
    uint core_wants_places;
};

#include "arithmetic/count.glsl"
#include "picture/look_beyond.glsl"
#include "picture/show.glsl"

core_location core_location_of(core_face_crossing nearest) {
    const bool has_found = nearest.face != CORE_NO_PATCH;
    const uvec4 place = elvis_fetch4_core_faces(has_found ? nearest.face : 0u, 0u);
    const elvis_vec3 xi = core_face_xi(int(place.y), nearest.u, nearest.v);
    core_location found = core_nothing_found();
    found.element = has_found ? place.x : CORE_NO_ELEMENT;
    found.number = nearest.number;
    found.key = nearest.key;
    found.x = xi.x;
    found.y = xi.y;
    found.z = xi.z;
    found.is_on_face = nearest.is_on_edge || nearest.is_folded;
    found.n_candidates = nearest.n_candidates;
    found.is_ambiguous = nearest.is_folded || (nearest.is_on_edge && core_is_discontinuous != 0u);
    return found;
}

// Evaluates the field where the ray meets the nearest face, and puts it into the picture if `is_shown`. Returns the number of
// evaluations.
uint core_show(uint pixel, core_ray ray, core_face_crossing nearest, bool is_shown, bool is_cut_short) {
    core_location found = core_location_of(nearest);
    found.is_cut_short = is_cut_short;
    const bool has_found = found.element != CORE_NO_ELEMENT;
    const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
    uint n_evaluations = 0u;
    if (is_shown && (has_found || is_cut_short)) {
        const elvis_vec3 position = ray.origin + nearest.t * ray.direction;
        const core_cut_point point = core_cut_point(has_found, false, false, nearest.t, position, ray.direction, ray.error);
        n_evaluations = core_merge(pixel, point, found, value);
    }
    if (n_evaluations > 0u) {
        const uint local_face = elvis_fetch4_core_faces(nearest.face, 0u).y;
        // At the crossing itself: where Newton's method took its last step from, the normal may be off by that step.
        if (core_wants_normals != 0u) {
            const core_face_point there = core_face_at(nearest.face, found.element, int(local_face), nearest.u, nearest.v);
            const elvis_vec3 normal = cross(there.along_u, there.along_v);
            const elvis_vec3 unit = -sign(dot(normal, ray.direction)) * normalize(normal);
            core_normals[3u * pixel] = unit.x;
            core_normals[3u * pixel + 1u] = unit.y;
            core_normals[3u * pixel + 2u] = unit.z;
        }
        if (core_wants_places != 0u) {
            core_places[pixel] =
                core_place(found.x, found.y, found.z, found.element, (CORE_CLASS << CORE_PLACE_FACE_BITS) | (local_face + 1u));
        }
#ifndef CORE_FACE_ORDER
        // The patches' bounds are those of polynomials near the faces.
        core_marks[pixel].flags |= CORE_FLAG_ESTIMATED;
#endif
    }
    return n_evaluations;
}
