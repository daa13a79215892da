// The nearest crossing of a ray with an isosurface that is known so far, found in this class of elements or in another one before.
//
// The kernel brings isosurface/isosurface_bindings.glsl.

#define CORE_NO_ELEMENT 0xffffffffu
// Unit normals that differ by less give the same colours.
#define CORE_SAME_NORMAL elvis_real(1e-3LF)

struct core_nearest_crossing {
    // Along the ray, within `slack`.
    elvis_real t, slack;
    // The field rises along the ray.
    bool rises;
    elvis_real xi_x, xi_y, xi_z;
    elvis_real isovalue;
    // The field's gradient in the world.
    elvis_real gradient_x, gradient_y, gradient_z;
    // Bound of the surface's curvature.
    elvis_real bend;
    // CORE_NO_ELEMENT if it was found in another class, or not yet.
    uint element;
    // Of the element among all of the volume: of elements that share a crossing, the least one has it.
    uint number;
    // False as near to a face as rounding moves the crossing: beyond the face there may be nothing. But true if another element has it,
    // too, with the same normal.
    bool is_certain;
};

// What another class has left in the pixel. `stretch`: length of the ray's direction; `reference_distance`: of the eye.
core_nearest_crossing core_nearest_begin(uint pixel, elvis_real stretch, elvis_real reference_distance) {
    const bool was_hit = core_marks[pixel].owner != 0u;
    core_nearest_crossing nearest;
    nearest.t = was_hit ? core_samples[pixel].depth / stretch - reference_distance : CORE_FAR;
    nearest.slack = was_hit ? elvis_real(16) * CORE_ROUNDOFF * core_samples[pixel].depth : elvis_real(0);
    nearest.rises = (core_marks[pixel].owner & CORE_OWNER_RISES) != 0u;
    nearest.xi_x = nearest.xi_y = nearest.xi_z = elvis_real(0);
    nearest.isovalue = was_hit ? core_samples[pixel].value : elvis_real(0);
    nearest.gradient_x = nearest.gradient_y = nearest.gradient_z = elvis_real(0);
    nearest.bend = CORE_FAR;
    nearest.element = CORE_NO_ELEMENT;
    nearest.number = was_hit ? core_samples[pixel].number : CORE_NO_NUMBER;
    nearest.is_certain = (core_marks[pixel].flags & CORE_FLAG_UNDECIDED) == 0u;
    return nearest;
}

// Where rays need not be looked at any more.
elvis_real core_nearest_end(const core_nearest_crossing nearest) { return nearest.t + nearest.slack; }

// The crossing of the last round, behind which the ray looks; of rounds that look from the eye on, none.
struct core_last_crossing {
    bool is_any;
    elvis_real t;
    core_crossing_record record;
};

// `t`: where the ray begins, behind the last crossing.
core_last_crossing core_last_crossing_of(uint pixel, elvis_real t) {
    core_last_crossing last;
    last.is_any = core_round > 0u;
    last.t = t;
    last.record = core_last[2u * pixel + (core_round + 1u) % 2u];
    return last;
}

// Whether that is found again, by an element that shares its face: as for core_nearest_take.
bool core_is_last_again(const core_last_crossing last, const core_nearest_crossing found) {
    const bool rose = (last.record.bits & CORE_CROSSING_RISES) != 0u, was_certain = (last.record.bits & CORE_CROSSING_CERTAIN) != 0u;
    const bool is_alike = found.rises == rose && found.isovalue == last.record.isovalue;
    return last.is_any && is_alike && !(found.is_certain && was_certain) && found.t - last.t <= max(found.slack, last.record.slack);
}

// Whether a crossing found is the last one because the ray has been in the same element since: before the field rises through an isovalue
// once more, it falls through it, and that would have been found first. However far rounding leads.
bool core_is_last_in_element(const core_last_crossing last, const core_nearest_crossing found) {
    const bool rose = (last.record.bits & CORE_CROSSING_RISES) != 0u;
    return last.is_any && found.rises == rose && found.isovalue == last.record.isovalue &&
           last.record.bits >> CORE_CROSSING_BITS == (found.number + 1u) << CORE_CROSSING_BITS >> CORE_CROSSING_BITS;
}

// Whether a crossing found lies ahead of where the ray starts, and behind a crossing that was found before.
bool core_is_ahead(const core_ray ray, elvis_real t, elvis_real slack) {
    return t > ray.counts_from + ray.widths_behind * slack && t > ray.counts_from;
}

// Whether that may be otherwise: rounding decides whether it is as far from the eye as those that count; or it can be one of its own all
// the same, farther from the last one than rounding leads at worst (isosurface/isosurface_blur.glsl).
bool core_is_ahead_doubtful(const core_ray ray, elvis_real t, elvis_real slack) {
    const elvis_real share = CORE_ROOT_SHARE * ray.widths_behind * slack;
    return core_is_at_start(ray, t, slack) || (!core_is_ahead(ray, t, slack) && share > elvis_real(0) && t > ray.counts_from + share);
}

// The normals are equal but for what nobody sees.
bool core_has_same_normal(const core_nearest_crossing one, const core_nearest_crossing other) {
    const elvis_vec3 a = elvis_vec3(one.gradient_x, one.gradient_y, one.gradient_z);
    const elvis_vec3 b = elvis_vec3(other.gradient_x, other.gradient_y, other.gradient_z);
    const elvis_vec3 sine = cross(a, b);
    return dot(sine, sine) <= CORE_SAME_NORMAL * CORE_SAME_NORMAL * dot(a, a) * dot(b, b);
}

// Takes what was found, if it is a crossing (`is_hit`), into account. `found` as above, certain if it surely lies in its element.
//
// Elements that share a face find a crossing in it twice, within rounding: both rise, or both fall. If one rises and the other falls, or
// if both surely lie in their elements, then they are two, and the first one counts, however large the bounds of rounding are.
void core_nearest_take(bool is_hit, const core_nearest_crossing found, inout core_nearest_crossing nearest) {
    const bool is_near = abs(found.t - nearest.t) <= max(found.slack, nearest.slack);
    const bool is_alike = found.rises == nearest.rises && found.isovalue == nearest.isovalue;
    const bool is_same = is_near && is_alike && !(found.is_certain && nearest.is_certain);
    const bool is_first = is_same && found.is_certain == nearest.is_certain ? found.number < nearest.number
                          : is_same                                         ? found.is_certain
                                                                            : found.t < nearest.t;
    const bool is_better = is_hit && is_first;
    const bool is_shared = is_same && nearest.element != found.element && core_has_same_normal(found, nearest);
    nearest.is_certain = is_better ? found.is_certain || is_shared : nearest.is_certain || (is_hit && is_shared);
    nearest.t = is_better ? found.t : nearest.t;
    nearest.slack = is_better ? found.slack : nearest.slack;
    nearest.rises = is_better ? found.rises : nearest.rises;
    nearest.xi_x = is_better ? found.xi_x : nearest.xi_x;
    nearest.xi_y = is_better ? found.xi_y : nearest.xi_y;
    nearest.xi_z = is_better ? found.xi_z : nearest.xi_z;
    nearest.isovalue = is_better ? found.isovalue : nearest.isovalue;
    nearest.gradient_x = is_better ? found.gradient_x : nearest.gradient_x;
    nearest.gradient_y = is_better ? found.gradient_y : nearest.gradient_y;
    nearest.gradient_z = is_better ? found.gradient_z : nearest.gradient_z;
    nearest.bend = is_better ? found.bend : nearest.bend;
    nearest.element = is_better ? found.element : nearest.element;
    nearest.number = is_better ? found.number : nearest.number;
}

// Flags of a pixel that has it, and puts it into the picture.
uint core_nearest_store(const core_nearest_crossing nearest, uint pixel, const core_ray ray, elvis_real stretch,
                        elvis_real reference_distance) {
    const bool is_hit = nearest.element != CORE_NO_ELEMENT;
    if (is_hit) {
        const uint bits = (nearest.rises ? CORE_CROSSING_RISES : 0u) | (nearest.is_certain ? CORE_CROSSING_CERTAIN : 0u) |
                          (nearest.number + 1u) << CORE_CROSSING_BITS;
        core_last[2u * pixel + core_round % 2u] = core_crossing_record(nearest.isovalue, nearest.slack, bits);
        core_store_crossing(pixel, core_surface_number, nearest.rises, nearest.isovalue, (nearest.t + reference_distance) * stretch,
                            nearest.number, elvis_vec3(nearest.gradient_x, nearest.gradient_y, nearest.gradient_z), ray.direction,
                            core_place(nearest.xi_x, nearest.xi_y, nearest.xi_z, nearest.element, CORE_CLASS << CORE_PLACE_FACE_BITS),
                            nearest.bend);
    }
    return (is_hit ? CORE_FLAG_ISOSURFACE : 0u) | (is_hit && !nearest.is_certain ? CORE_FLAG_UNDECIDED : 0u);
}
