// Where the rays of a picture meet one cut plane, for the elements of one class: finds the element, evaluates the field.
//
// Several planes and classes merge in core_samples: the nearest plane wins; on one plane, the element on the viewer's side, then the
// lowest number. One field evaluation a pixel and class, after the search.

#include "library/precision.glsl"
#include "library/newton.glsl"
#include "library/hierarchy.glsl"

layout(local_size_x = 32) in;

#include "library/cut_frame.glsl"
#include "library/samples.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_row;
    uint core_surface;
    // Component of the field; CORE_MAGNITUDE for the length of the vector.
    uint core_component;
    // Two values on a face: which one is shown there depends on rounding.
    uint core_is_discontinuous;
};

#define CORE_MAGNITUDE 0xffffffffu
// Nodes and Newton steps of one pixel. A driver ends loops silently at 65535 iterations; this is far above any sensible search.
#define CORE_WORK_LIMIT 30000u

elvis_real core_shown_value(uint element, elvis_vec3 xi) {
    elvis_real sum = elvis_real(0);
    if (core_component != CORE_MAGNITUDE) {
        return elvis_field_value(element, xi, core_component);
    }
    for (uint component = 0u; component < ELVIS_N_COMPONENTS; ++component) {
        const elvis_real value = elvis_field_value(element, xi, component);
        sum += value * value;
    }
    return sqrt(sum);
}

// 0 if a small step from xi towards the viewer stays in the element: the constraints of all faces within tolerance fall. 1 otherwise.
uint core_side_key(elvis_vec3 xi, elvis_real tolerance, elvis_vec3 towards_viewer) {
    uint key = 0u;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const bool is_active = dot(constraint.xyz, xi) + constraint.w > -tolerance;
        key = is_active && dot(constraint.xyz, towards_viewer) > elvis_real(0) ? 1u : key;
    }
    return key;
}

void main() {
    const uint column = gl_GlobalInvocationID.x;
    const uint row = core_first_row + gl_GlobalInvocationID.y;
    const uint pixel = row * core_size.x + column;
    bool is_active = column < core_size.x && row < core_size.y;
    const core_cut_point point = core_cut_pixel(elvis_real(column), elvis_real(row));
    const elvis_real depth = (point.t + core_reference.w) * length(point.direction);
    core_sample best = core_no_sample();
    if (is_active) {
        best = core_samples[pixel];
    }
    is_active = is_active && point.is_hit && (best.surface == core_surface || !(best.depth <= depth));
    const bool is_same_surface = best.surface == core_surface;
    uint best_key = is_same_surface ? best.key : 2u;
    uint best_number = is_same_surface ? best.number : 0xffffffffu;

    const vec3 in_hierarchy = vec3(point.position + core_reference_in_hierarchy.xyz);
    // Rounding of the point, and of its conversion to single precision.
    const float box_tolerance =
        float(point.error) * 2.0 + 1.2e-7 * max(max(abs(in_hierarchy.x), abs(in_hierarchy.y)), abs(in_hierarchy.z));

    uint stack[CORE_STACK_SIZE];
    uint depth_of_stack = is_active && core_contains(core_fetch_node(0u), in_hierarchy, box_tolerance) ? 1u : 0u;
    stack[0] = 0u;
    uint work = 0u;
    uint iterations = 0u;
    uint failures = 0u;
    uint n_inside = 0u;
    uint found = CORE_NO_NODE;
    elvis_real found_x = elvis_real(0), found_y = elvis_real(0), found_z = elvis_real(0);
    bool is_on_face = false;

    while (depth_of_stack > 0u && work < CORE_WORK_LIMIT) {
        // The next element whose bounds contain the point.
        uint element = CORE_NO_NODE;
        while (depth_of_stack > 0u && element == CORE_NO_NODE) {
            ++work;
            depth_of_stack -= 1u;
            // Nodes on the stack contain the point: one step for each of them, none for their siblings.
            const core_node node = core_fetch_node(stack[depth_of_stack]);
            if (node.is_leaf) {
                element = node.child;
            } else {
                if (core_contains(core_fetch_node(node.child + 1u), in_hierarchy, box_tolerance)) {
                    stack[depth_of_stack] = node.child + 1u;
                    depth_of_stack += 1u;
                }
                if (core_contains(core_fetch_node(node.child), in_hierarchy, box_tolerance)) {
                    stack[depth_of_stack] = node.child;
                    depth_of_stack += 1u;
                }
            }
        }
        // Its reference coordinates there.
        const bool has_element = element != CORE_NO_NODE;
        const uint safe_element = has_element ? element : 0u;
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
        const elvis_vec3 target = shift + point.position;
        const elvis_real position_error = point.error + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
        const elvis_vec3 middle = CORE_CENTROID;
        core_newton state = core_newton_begin(middle.x, middle.y, middle.z, false);
        core_inverse inverse_jacobian;
        elvis_real error = elvis_real(0);
        elvis_real towards_x = elvis_real(0), towards_y = elvis_real(0), towards_z = elvis_real(0);
        uint status = has_element ? CORE_NEWTON_RUNNING : CORE_NEWTON_OUTSIDE;
        while (status == CORE_NEWTON_RUNNING) {
            status = core_newton_step(safe_element, target, position_error, state, inverse_jacobian);
            error = max(max(inverse_jacobian.error0, inverse_jacobian.error1), inverse_jacobian.error2);
            towards_x = -dot(inverse_jacobian.row0, point.direction);
            towards_y = -dot(inverse_jacobian.row1, point.direction);
            towards_z = -dot(inverse_jacobian.row2, point.direction);
            ++iterations;
            ++work;
        }
        failures += status == CORE_NEWTON_FAILED ? 1u : 0u;
        // Within rounding of a face counts as inside: neighbours must not leave a gap. 2: both the point's error and the solution's.
        const elvis_real tolerance = elvis_real(2) * error + elvis_real(4) * CORE_ROUNDOFF;
        const elvis_real excess = core_excess(state.x, state.y, state.z);
        const bool is_inside = status == CORE_NEWTON_CONVERGED && excess <= tolerance;
        const uint key = core_side_key(elvis_vec3(state.x, state.y, state.z), tolerance, elvis_vec3(towards_x, towards_y, towards_z));
        const uint number = elvis_fetch_core_numbers(safe_element, 0u);
        n_inside += is_inside ? 1u : 0u;
        if (is_inside && (key < best_key || (key == best_key && number < best_number))) {
            best_key = key;
            best_number = number;
            found = element;
            found_x = state.x;
            found_y = state.y;
            found_z = state.z;
            is_on_face = excess > -tolerance;
        }
    }
    const bool is_cut_short = depth_of_stack > 0u;

    // A loop of one turn, because a branch would be evaluated for every pixel by drivers that compute all lanes.
    elvis_real value = elvis_real(0);
    uint n_evaluations = 0u;
    for (uint turn = 0u; turn < (found != CORE_NO_NODE ? 1u : 0u); ++turn) {
        value = core_shown_value(found, elvis_vec3(found_x, found_y, found_z));
        n_evaluations += core_component == CORE_MAGNITUDE ? ELVIS_N_COMPONENTS : 1u;
    }
    if (is_active && (found != CORE_NO_NODE || failures > 0u || is_cut_short)) {
        if (found != CORE_NO_NODE) {
            // Of another plane, flags are of no interest any more.
            best.flags = is_same_surface ? best.flags : 0u;
            best.surface = core_surface;
            best.depth = depth;
            best.value = value;
            best.key = best_key;
            best.number = best_number;
            // On a face: the domain may end there, or the field may have two values.
            const bool is_undecided = is_on_face && (core_is_discontinuous != 0u || (n_inside < 2u && !is_same_surface));
            best.flags = is_undecided ? best.flags | CORE_FLAG_UNDECIDED : best.flags & ~CORE_FLAG_UNDECIDED;
        }
        best.flags |= failures > 0u ? CORE_FLAG_NEWTON_FAILURE : 0u;
        best.flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
        core_samples[pixel] = best;
    }

    const uint all_evaluations = subgroupAdd(n_evaluations);
    const uint all_iterations = subgroupAdd(iterations);
    const uint all_failures = subgroupAdd(failures);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
        atomicAdd(core_counts[1], all_iterations);
        atomicAdd(core_counts[2], all_failures);
    }
}
