// What is found along a pixel's ray, and how it gets into the picture: the nearest surface wins; on one surface, the element on the
// viewer's side, then the lowest number.
//
// The kernel brings picture/view.glsl, picture/samples.glsl, core_samples, core_marks, core_surface_number, core_first_component,
// core_end_component and core_value_tolerance.

#include "arithmetic/driver_limit.glsl"
#include "field/shown_value.glsl"

#define CORE_NO_ELEMENT 0xffffffffu

struct core_location {
    // Local element, or CORE_NO_ELEMENT.
    uint element;
    uint number;
    uint key;
    elvis_real x, y, z;
    // The point lies on a face of the element, within rounding.
    bool is_on_face;
    // Elements of the class that hold the point within rounding. They may have other values there.
    uint n_candidates;
    // Those that hold it by more than rounding: of a valid mesh one at most.
    uint n_holders;
    // More may be shown here than the elements that share the point show: other values, or nothing.
    bool is_ambiguous;
    // One of those that are not shown, and the point in it.
    uint other;
    elvis_real other_x, other_y, other_z;
    uint n_steps;
    uint n_failures;
    // The search was ended before it was done.
    bool is_cut_short;
    // Elements that were dismissed and may hold the point all the same: how many, and two of them (cut_surface/open_points.comp).
    uint n_open;
    uint open_element, other_open_element;
};

core_location core_nothing_found() {
    const elvis_real zero = elvis_real(0);
    return core_location(CORE_NO_ELEMENT, 0xffffffffu, 2u, zero, zero, zero, false, 0u, 0u, false, CORE_NO_ELEMENT, zero, zero, zero,
                         0u, 0u, false, 0u, CORE_NO_ELEMENT, CORE_NO_ELEMENT);
}

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

    const bool is_other_class = has_found && is_same_surface;
    uint owner = is_shown ? (core_surface_number << CORE_OWNER_BITS) | found.key | (found.is_on_face ? CORE_OWNER_ON_FACE : 0u)
                          : old_owner;
    const bool is_shared = is_other_class || (is_shown && found.n_candidates > 1u);
    owner |= is_shared ? CORE_OWNER_SHARED : 0u;
    // Where classes meet; within one, the caller says so or cut_surface/other_values.comp does.
    const bool is_other_value =
        is_other_class && !(abs(value - core_samples[pixel].value) <= elvis_real(core_value_tolerance));
    owner |= is_other_value || ((is_shown || is_other_class) && found.is_ambiguous) ? CORE_OWNER_AMBIGUOUS : 0u;
    const bool is_held_twice = is_other_class && found.n_holders > 0u && (old_owner & CORE_OWNER_ON_FACE) == 0u;
    owner |= is_held_twice || ((is_shown || is_other_class) && found.n_holders > 1u) ? CORE_OWNER_OVERLAP : 0u;
    owner |= is_other_class ? old_owner & (CORE_OWNER_AMBIGUOUS | CORE_OWNER_OVERLAP) : 0u;
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
