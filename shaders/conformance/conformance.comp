// Everything that a snippet gives, at chosen reference points: what `elvis check-plugin` looks at. Needs a device with float64.

layout(local_size_x = 8) in;

struct core_point {
    double x, y, z;
    uint element;
    uint component;
};

// Numbers a point; the order is that of core/conformance/device_sampler.hpp.
#define CORE_N_NUMBERS 111u

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { double core_results[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void core_write_vector(uint first, elvis_vec3 v) {
    core_results[first] = double(v.x);
    core_results[first + 1u] = double(v.y);
    core_results[first + 2u] = double(v.z);
}

void core_write_matrix(uint first, elvis_mat3 m) {
    core_write_vector(first, m[0]);
    core_write_vector(first + 3u, m[1]);
    core_write_vector(first + 6u, m[2]);
}

struct core_point_at_hand {
    uint element, component;
    elvis_vec3 xi;
    // Where its numbers begin.
    uint first;
};

void core_write_inverse(core_point_at_hand point, elvis_vec3 position) {
    elvis_vec3 inverse = elvis_vec3(0);
    bool is_found = false;
#if ELVIS_HAS_INVERSE_MAPPING
    is_found = elvis_inverse_mapping(point.element, position, inverse);
#endif
    core_results[point.first + 29u] = is_found ? 1.0LF : 0.0LF;
    core_write_vector(point.first + 30u, inverse);
}

// `value` to `jacobian`: what stands there without second derivatives.
void core_write_hessians(core_point_at_hand point, elvis_real value, elvis_vec3 gradient, elvis_vec3 x, elvis_mat3 jacobian) {
    elvis_mat3 hessian = elvis_mat3(0), hessian_x = elvis_mat3(0), hessian_y = elvis_mat3(0), hessian_z = elvis_mat3(0);
#if ELVIS_WANTS_HESSIANS
    elvis_field_hessian(point.element, point.xi, point.component, value, gradient, hessian);
    elvis_mapping_hessian(point.element, point.xi, x, jacobian, hessian_x, hessian_y, hessian_z);
#endif
    core_results[point.first + 33u] = double(value);
    core_write_vector(point.first + 34u, gradient);
    core_write_matrix(point.first + 37u, hessian);
    core_write_vector(point.first + 46u, x);
    core_write_matrix(point.first + 49u, jacobian);
    core_write_matrix(point.first + 58u, hessian_x);
    core_write_matrix(point.first + 67u, hessian_y);
    core_write_matrix(point.first + 76u, hessian_z);
}

void core_write_inside(core_point_at_hand point) {
    elvis_real inside = elvis_real(0);
    elvis_vec3 gradient = elvis_vec3(0);
    elvis_vec2 bounds = elvis_vec2(0);
#if ELVIS_HAS_INSIDE
    elvis_inside(point.element, point.xi, inside, gradient);
    bounds = elvis_inside_bounds(point.element);
#endif
    core_results[point.first + 105u] = double(inside);
    core_write_vector(point.first + 106u, gradient);
    core_results[point.first + 109u] = double(bounds.x);
    core_results[point.first + 110u] = double(bounds.y);
}

// What elvis_field_value and elvis_mapping said; the other functions call them again.
void core_write_debug(uint first) {
#ifdef CORE_DEBUG_BUILD
    core_results[first + 86u] = double(core_n_debug);
    for (uint i = 0u; i < CORE_N_DEBUG; ++i) {
        core_results[first + 87u + i] = i < core_n_debug ? core_debug[i] : 0.0LF;
    }
#endif
}

// Of all calls.
void core_write_faults(uint first) {
#ifdef CORE_DEBUG_BUILD
    core_results[first + 85u] = core_is_endless ? 1.0LF : 0.0LF;
    core_results[first + 102u] = double(core_bad_index_line);
    core_results[first + 103u] = core_bad_index;
    core_results[first + 104u] = core_bad_index_limit;
#else
    core_results[first + 85u] = 0.0LF;
#endif
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const uint first = CORE_N_NUMBERS * index;
    const core_point given = core_points[index];
    const core_point_at_hand point =
        core_point_at_hand(given.element, given.component, elvis_vec3(given.x, given.y, given.z), first);

    core_results[first] = double(elvis_field_value(point.element, point.xi, point.component));
    const elvis_vec3 position = elvis_mapping(point.element, point.xi);
    core_write_debug(first);
    elvis_real value;
    elvis_vec3 gradient;
    elvis_field_gradient(point.element, point.xi, point.component, value, gradient);
    core_results[first + 1u] = double(value);
    core_write_vector(first + 2u, gradient);

    core_write_vector(first + 5u, position);
    core_write_matrix(first + 8u, elvis_jacobian(point.element, point.xi));
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(point.element, point.xi, x, jacobian);
    core_write_vector(first + 17u, x);
    core_write_matrix(first + 20u, jacobian);
    core_write_inverse(point, position);
    core_write_hessians(point, value, gradient, x, jacobian);
    core_write_inside(point);
    core_write_faults(first);
}
