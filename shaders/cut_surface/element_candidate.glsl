// One element that may hold a point of a cut surface (cut_surface/locate.glsl, cut_surface/open_points.comp): where Newton's method starts
// in it, and what its solution says.
//
// The kernel brings picture/show.glsl and the buffers core_nodes and core_elements (element/linearization.glsl), and
// CORE_ON_PLANE: 1 for a cut plane, 0 for other surfaces.

#include "element/newton.glsl"
#include "tiles/hierarchy.glsl"
#include "element/inside.glsl"
#include "element/linearization.glsl"
#include "cut_surface/reach.glsl"

#if CORE_ON_PLANE
#include "cut_surface/meets_plane.glsl"
#define core_may_hold(node) core_meets_plane(node)
#else
#define core_may_hold(node) true
#endif

struct core_side {
    bool is_inside, is_on_face;
    uint key;
    // On which the point lies within rounding; counted where it lies on one.
    uint n_faces;
};

// Classifies a converged point near a face, with each face's own rounding.
core_side core_side_of(elvis_vec3 xi, core_inverse inverse, elvis_vec3 direction) {
    const elvis_vec3 error = elvis_real(2) * elvis_vec3(inverse.error0, inverse.error1, inverse.error2);
    const elvis_vec3 towards_viewer = -elvis_vec3(dot(inverse.row0, direction), dot(inverse.row1, direction), dot(inverse.row2, direction));
    core_side side = core_side(true, false, 0u, 0u);
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real distance = dot(constraint.xyz, xi) + constraint.w;
        const elvis_real tolerance = dot(abs(constraint.xyz), error);
        const bool is_active = distance >= -tolerance;
        side.is_inside = side.is_inside && distance <= tolerance;
        side.is_on_face = side.is_on_face || is_active;
        side.n_faces += is_active ? 1u : 0u;
        side.key = is_active && dot(constraint.xyz, towards_viewer) > elvis_real(0) ? 1u : side.key;
    }
    return side;
}

#if ELVIS_HAS_INSIDE
// The same for the element's own boundary, added to what the faces say.
void core_add_own_side(uint element, elvis_vec3 xi, core_inverse inverse, elvis_vec3 direction, inout core_side side) {
    const core_inside g = core_inside_at(element, xi);
    const elvis_vec3 error = elvis_real(2) * elvis_vec3(inverse.error0, inverse.error1, inverse.error2);
    const elvis_vec3 towards_viewer = -elvis_vec3(dot(inverse.row0, direction), dot(inverse.row1, direction), dot(inverse.row2, direction));
    const elvis_real tolerance = dot(abs(g.slope), error) + g.rounding;
    const bool is_active = g.value >= -tolerance;
    side.is_inside = side.is_inside && g.value <= tolerance;
    side.is_on_face = side.is_on_face || is_active;
    side.n_faces += is_active ? 1u : 0u;
    side.key = is_active && dot(g.slope, towards_viewer) > elvis_real(0) ? 1u : side.key;
}
#endif

// The data's own error: coordinates come in double precision, and a solver or converter has rounded them a few times. Neighbours'
// faces, and a plane that is to lie in them, agree no better. Measured: 28 roundings of the volume's largest coordinate.
elvis_real core_data_error() {
    const core_node root = core_fetch_node(0u);
    const vec3 centre = vec3(core_reference.xyz - core_reference_in_hierarchy.xyz);
    const vec3 farthest = abs(centre) + max(abs(root.lower), abs(root.upper));
    return elvis_real(3.6e-15LF) * elvis_real(max(max(farthest.x, farthest.y), farthest.z));
}

// Of boxes: rounding of the point, and of its conversion to single precision.
float core_box_tolerance(core_cut_point point, vec3 in_hierarchy) {
    return 2.0 * float(point.error) +
           2.0 * CORE_FLOAT_ROUNDOFF * max(max(abs(in_hierarchy.x), abs(in_hierarchy.y)), abs(in_hierarchy.z));
}

struct core_target {
    // In the snippet's coordinates, and its rounding error.
    elvis_real x, y, z;
    elvis_real error;
};

core_target core_target_in(uint element, core_cut_point point) {
    // elvis_origin is zero where the snippet's coordinates are the world's.
    const elvis_vec3 shift = core_reference.xyz - elvis_origin(element);
    const elvis_vec3 x = shift + point.position;
    return core_target(x.x, x.y, x.z, point.error + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z)));
}

// From the linearized mapping, or from the centroid where there is none.
core_newton core_newton_start(uint element, elvis_vec3 target) {
    const core_linearization linearization = core_fetch_linearization(element);
    const bool is_linearized = linearization.exponents != 0u;
    const elvis_vec3 middle = CORE_CENTROID;
    const elvis_vec3 start = is_linearized ? elvis_vec3(core_linear_inverse(linearization, vec3(target))) : middle;
    const elvis_vec3 moved = abs(start - middle);
    return core_newton_begin(start.x, start.y, start.z, is_linearized ? max(max(moved.x, moved.y), moved.z) : elvis_real(-1),
                             elvis_real(core_curvature(linearization.exponents)));
}

// The linearized mapping keeps this many digits of coordinates in the element.
#define CORE_START_ERROR elvis_real(1e-2LF)

// Whether the start alone, a prediction from the centroid, is far enough outside.
bool core_is_outside(uint element, core_newton start) {
    bool is_outside = core_excess(start.x, start.y, start.z) >
                      CORE_CONSTRAINT_NORM *
                          (core_prediction_error_within(start.curvature, start.last_step, CORE_EXTENT) + CORE_START_ERROR);
#ifdef elvis_fetch4_core_reaches
    const elvis_vec3 linear = elvis_vec3(start.x, start.y, start.z);
    is_outside = is_outside || core_is_beyond_reach(elvis_fetch4_core_reaches(element, 0u), linear, CORE_START_ERROR);
#endif
    return is_outside;
}

struct core_element_candidate {
    // CORE_NO_ELEMENT: none is looked at.
    uint element;
    // It held the column's last pixel.
    bool is_tracked;
    core_target target;
    core_newton state;
};

// Where the candidate's solution lies in its element. `excess`: over the faces; `most`: what rounding makes of it.
core_side core_judge_candidate(uint element, core_element_candidate candidate, core_inverse inverse, elvis_vec3 direction,
                               bool has_converged, elvis_real excess, elvis_real most) {
    const elvis_vec3 xi = elvis_vec3(candidate.state.x, candidate.state.y, candidate.state.z);
    const bool is_inside = has_converged && excess <= most;
    core_side side = core_side(is_inside, is_inside && excess >= -most, 0u, 0u);
    if (side.is_on_face) {
        side = core_side_of(xi, inverse, direction);
    }
#if ELVIS_HAS_INSIDE
    if (side.is_inside) {
        core_add_own_side(element, xi, inverse, direction, side);
    }
#endif
    return side;
}

// An element that holds the point by more than rounding goes before all that hold it within rounding, whichever was found first.
void core_forget_candidates(bool is_forgotten, inout core_location found) {
    found.element = is_forgotten ? CORE_NO_ELEMENT : found.element;
    found.number = is_forgotten ? 0xffffffffu : found.number;
    found.key = is_forgotten ? 2u : found.key;
    found.n_candidates = is_forgotten ? 0u : found.n_candidates;
    found.other = is_forgotten ? CORE_NO_ELEMENT : found.other;
    found.is_ambiguous = found.is_ambiguous && !is_forgotten;
}

// Takes the candidate if it goes before what was found; the other one is kept for comparison.
void core_take_candidate(bool is_accepted, core_element_candidate candidate, uint number, core_side side, inout core_location found) {
    const bool is_better = is_accepted && (side.key < found.key || (side.key == found.key && number < found.number));
    const bool is_other = is_accepted && !is_better, was_found = is_better && found.element != CORE_NO_ELEMENT;
    found.n_candidates += is_accepted ? 1u : 0u;
    found.other = is_other ? candidate.element : was_found ? found.element : found.other;
    found.other_x = is_other ? candidate.state.x : was_found ? found.x : found.other_x;
    found.other_y = is_other ? candidate.state.y : was_found ? found.y : found.other_y;
    found.other_z = is_other ? candidate.state.z : was_found ? found.z : found.other_z;
    found.element = is_better ? candidate.element : found.element;
    found.number = is_better ? number : found.number;
    found.key = is_better ? side.key : found.key;
    found.x = is_better ? candidate.state.x : found.x;
    found.y = is_better ? candidate.state.y : found.y;
    found.z = is_better ? candidate.state.z : found.z;
    found.is_on_face = is_better ? side.is_on_face : found.is_on_face;
    // Where two faces of an element meet the domain may end, however many elements do.
    found.is_ambiguous = found.is_ambiguous || (is_accepted && side.n_faces > 1u);
}
