// From element to element through shared faces: the way on where a ray's end in an element does not tell it.
//
// The kernel brings library/ray_part.glsl; core_links; and core_first_element and core_n_elements, the class's among all elements of the
// volume, which links are of.

#ifndef CORE_CHAIN_WALK
#define CORE_CHAIN_WALK

#ifndef CORE_NO_LINK
#define CORE_NO_LINK 0xffffffffu
#endif
#ifndef CORE_NO_ELEMENT
#define CORE_NO_ELEMENT 0xffffffffu
#endif

// Elements looked at for the one that holds a point of the ray, when rounding has led it past an edge.
#define CORE_MOST_HOPS 16u
// Of rays along faces: steps towards where they leave; violation of the face within which they run along it.
#define CORE_ROUGH_TURNS 8u
#define CORE_ALONG 1e-5

// Goes on from element to element towards the point of the ray at t, until one holds it: its position in the class; or
// CORE_NO_ELEMENT, and in `other` the element of another class in which to go on, if there is one.
uint core_find_around(core_walk_ray ray, uint element, elvis_real t, out uint other) {
    other = CORE_NO_LINK;
    uint hops = 0u;
    bool is_found = false;
    elvis_real x = CORE_CENTROID.x, y = CORE_CENTROID.y, z = CORE_CENTROID.z;
    uint steps = 0u;
    bool is_over = false;
    while (!is_over) {
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, elvis_vec3(x, y, z), position, jacobian);
        const core_frame frame = core_frame_at(position, jacobian, ray.error);
        const elvis_vec3 step = core_to_xi(frame, core_part_target(ray, element, t) - position);
        const elvis_vec3 next = elvis_vec3(x, y, z) + clamp(step, elvis_vec3(-4), elvis_vec3(4));
        steps += 1u;
        const bool is_there = core_max_norm(step) <= elvis_real(4) * core_max_norm(frame.xi_error) || steps >= 8u;
        elvis_real worst = elvis_real(-4);
        uint worst_face = 0u;
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const elvis_vec4 constraint = core_face_constraint(face);
            const elvis_real excess = dot(constraint.xyz, next) + constraint.w;
            worst_face = excess > worst ? uint(face) : worst_face;
            worst = max(worst, excess);
        }
        is_found = is_there && worst <= elvis_real(4) * core_max_norm(frame.xi_error);
        const bool leaves = is_there && !is_found;
        const uint link = elvis_fetch_core_links(element, worst_face);
        const bool is_own = link != CORE_NO_LINK && link >= core_first_element && link - core_first_element < core_n_elements;
        hops += leaves ? 1u : 0u;
        other = leaves && !is_own ? link : other;
        is_over = is_found || (leaves && !is_own) || hops >= CORE_MOST_HOPS || !frame.is_sound;
        element = leaves && is_own ? link - core_first_element : element;
        steps = leaves ? 0u : steps;
        elvis_real new_x = next.x, new_y = next.y, new_z = next.z;
        core_project(new_x, new_y, new_z);
        x = leaves ? CORE_CENTROID.x : new_x;
        y = leaves ? CORE_CENTROID.y : new_y;
        z = leaves ? CORE_CENTROID.z : new_z;
    }
#if ELVIS_HAS_INSIDE
    // Beyond the element's own boundary there is no one to ask.
    is_found = is_found && core_is_within(element, elvis_vec3(x, y, z), elvis_vec3(CORE_ALONG));
#endif
    return is_found ? element : CORE_NO_ELEMENT;
}

// Where the ray leaves the element as Newton's method predicts it, without bounds: for rays that run along a curved face within
// rounding, which is then left out. The result stands in the part, which is an estimate.
void core_leave_roughly(core_walk_ray ray, elvis_real from, inout core_part part) {
    elvis_real leave = from;
    int leave_face = CORE_NO_FACE;
    for (uint turn = 0u; turn < CORE_ROUGH_TURNS; ++turn) {
        elvis_real x = part.x + (leave - part.anchor) * part.slope_x, y = part.y + (leave - part.anchor) * part.slope_y;
        elvis_real z = part.z + (leave - part.anchor) * part.slope_z;
        core_project(x, y, z);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(part.element, elvis_vec3(x, y, z), position, jacobian);
        const core_frame frame = core_frame_at(position, jacobian, ray.error);
        const elvis_vec3 at = elvis_vec3(x, y, z) + core_to_xi(frame, core_part_target(ray, part.element, leave) - position);
        const elvis_vec3 slope = core_to_xi(frame, ray.direction);
        elvis_real first = from + ray.reach;
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const elvis_vec4 constraint = core_face_constraint(face);
            const elvis_real value = dot(constraint.xyz, at) + constraint.w, rate = dot(constraint.xyz, slope);
            const elvis_real root = leave - value / rate;
            const bool is_along = abs(value) + abs(value + (from - leave) * rate) <= elvis_real(CORE_ALONG);
            const bool is_first = rate > elvis_real(0) && !is_along && root > from && root < first;
            leave_face = is_first ? face : leave_face;
            first = is_first ? root : first;
        }
        part.x = at.x;
        part.y = at.y;
        part.z = at.z;
        part.slope_x = slope.x;
        part.slope_y = slope.y;
        part.slope_z = slope.z;
        part.anchor = leave;
        leave = first;
    }
    part.enter = from;
    part.enter_error = elvis_real(0);
    part.leave = leave;
    part.leave_face = leave_face;
    part.is_estimated = true;
}

#endif
