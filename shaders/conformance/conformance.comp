// Everything that a snippet gives, at chosen reference points: what `elvis check-plugin` looks at. Needs a device with float64.

layout(local_size_x = 8) in;

#include "conformance/points.glsl"

// Numbers a point; the order is that of core/conformance/device_sampler.hpp.
#define CORE_N_NUMBERS 111u

void core_write_value(uint first, uint element, elvis_vec3 xi, uint component) {
    core_results[first] = double(elvis_field_value(element, xi, component));
    const elvis_vec3 position = elvis_mapping(element, xi);
#ifdef CORE_DEBUG_BUILD
    // What elvis_field_value and elvis_mapping said; the other functions call them again.
    core_results[first + 86u] = double(core_n_debug);
    for (uint i = 0u; i < CORE_N_DEBUG; ++i) {
        core_results[first + 87u + i] = i < core_n_debug ? core_debug[i] : 0.0LF;
    }
#endif
    core_write_vector(first + 5u, position);
    elvis_vec3 inverse = elvis_vec3(0);
    bool is_found = false;
#if ELVIS_HAS_INVERSE_MAPPING
    is_found = elvis_inverse_mapping(element, position, inverse);
#endif
    core_results[first + 29u] = is_found ? 1.0LF : 0.0LF;
    core_write_vector(first + 30u, inverse);
}

void core_write_derivatives(uint first, uint element, elvis_vec3 xi, uint component) {
    elvis_real value;
    elvis_vec3 gradient, x;
    elvis_mat3 jacobian, hessian = elvis_mat3(0), hessian_x = elvis_mat3(0), hessian_y = elvis_mat3(0), hessian_z = elvis_mat3(0);
    elvis_field_gradient(element, xi, component, value, gradient);
    core_results[first + 1u] = double(value);
    core_write_vector(first + 2u, gradient);
    core_write_matrix(first + 8u, elvis_jacobian(element, xi));
    elvis_mapping_jacobian(element, xi, x, jacobian);
    core_write_vector(first + 17u, x);
    core_write_matrix(first + 20u, jacobian);
#if ELVIS_WANTS_HESSIANS
    elvis_field_hessian(element, xi, component, value, gradient, hessian);
    elvis_mapping_hessian(element, xi, x, jacobian, hessian_x, hessian_y, hessian_z);
#endif
    core_results[first + 33u] = double(value);
    core_write_vector(first + 34u, gradient);
    core_write_matrix(first + 37u, hessian);
    core_write_vector(first + 46u, x);
    core_write_matrix(first + 49u, jacobian);
    core_write_matrix(first + 58u, hessian_x);
    core_write_matrix(first + 67u, hessian_y);
    core_write_matrix(first + 76u, hessian_z);
}

void core_write_inside(uint first, uint element, elvis_vec3 xi) {
    elvis_real inside = elvis_real(0);
    elvis_vec3 gradient = elvis_vec3(0);
    elvis_vec2 bounds = elvis_vec2(0);
#if ELVIS_HAS_INSIDE
    elvis_inside(element, xi, inside, gradient);
    bounds = elvis_inside_bounds(element);
#endif
    core_results[first + 105u] = double(inside);
    core_write_vector(first + 106u, gradient);
    core_results[first + 109u] = double(bounds.x);
    core_results[first + 110u] = double(bounds.y);
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const core_point point = core_points[index];
    const elvis_vec3 xi = elvis_vec3(point.x, point.y, point.z);
    const uint first = CORE_N_NUMBERS * index;
    core_write_value(first, point.element, xi, point.component);
    core_write_derivatives(first, point.element, xi, point.component);
    core_write_inside(first, point.element, xi);
#ifdef CORE_DEBUG_BUILD
    core_results[first + 85u] = core_is_endless ? 1.0LF : 0.0LF;
    core_results[first + 102u] = double(core_bad_index_line);
    core_results[first + 103u] = core_bad_index;
    core_results[first + 104u] = core_bad_index_limit;
#else
    core_results[first + 85u] = 0.0LF;
#endif
}
