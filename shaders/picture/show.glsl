// What is found along a pixel's ray, and how it gets into the picture: the nearest surface wins; on one surface, the element on the
// viewer's side, then the lowest number.
//
// The kernel brings picture/view.glsl, picture/samples.glsl, core_samples, core_marks, core_surface_number, core_first_component,
// core_end_component and core_is_discontinuous.

#include "arithmetic/driver_limit.glsl"
#include "field/shown_value.glsl"

#define CORE_NO_ELEMENT 0xffffffffu

struct core_location {
    // Local element, or CORE_NO_ELEMENT.
    uint element;
    uint number;
    uint key;
    elvis_real x, y, z;
    // The point lies on a face of the element, within rounding; on one that crosses the surface.
    bool is_on_face, is_on_crossing_face;
    uint n_candidates;
    uint n_steps;
    uint n_failures;
    // The search was ended before it was done.
    bool is_cut_short;
};

// Puts what was found into the picture, unless another surface or element goes before it. Returns the number of field evaluations.
uint core_merge(uint pixel, core_cut_point point, core_location found, elvis_real value) {
    const elvis_real depth = (point.t + core_reference.w) * length(point.direction);
    const uint old_owner = core_marks[pixel].owner;
    const uint old_surface = old_owner >> CORE_OWNER_BITS;
    const uint old_number = core_samples[pixel].number;
    const bool has_found = found.element != CORE_NO_ELEMENT;
    const bool is_same_surface = old_surface == core_surface_number;
    const uint old_key = old_owner & CORE_OWNER_KEY;
    const bool is_nearer = old_surface == 0u || depth < core_samples[pixel].depth;
    const bool is_better = found.key < old_key || (found.key == old_key && found.number < old_number);
    const bool is_shown = has_found && (is_same_surface ? is_better : is_nearer);

    const bool is_ambiguous = found.is_on_crossing_face && core_is_discontinuous != 0u;
    uint owner = is_shown ? (core_surface_number << CORE_OWNER_BITS) | found.key | (found.is_on_face ? CORE_OWNER_ON_FACE : 0u) |
                                (is_ambiguous ? CORE_OWNER_AMBIGUOUS : 0u)
                          : old_owner;
    const bool is_shared = has_found && (is_same_surface || (is_shown && found.n_candidates > 1u));
    owner |= is_shared ? CORE_OWNER_SHARED : 0u;
    core_marks[pixel].owner = owner;
    const uint flags = (found.n_failures > 0u ? CORE_FLAG_NEWTON_FAILURE : 0u) | (found.is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u) |
                       (is_shown ? CORE_VALUE_FLAGS : 0u);
    if (flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    if (is_shown) {
        core_samples[pixel].value = value;
        core_samples[pixel].depth = depth;
        core_samples[pixel].number = found.number;
    }
    return is_shown ? core_end_component - core_first_component : 0u;
}
