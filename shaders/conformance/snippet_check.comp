// Everything that a snippet gives, at chosen reference points: what plugins are checked with. Needs a device with float64.
//
// 20 numbers a point: elvis_field_value; value and gradient of elvis_field_gradient; elvis_mapping; position and Jacobian (columns) of
// elvis_mapping_jacobian.

layout(local_size_x = 8) in;

#include "conformance/points.glsl"

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const core_point point = core_points[index];
    const elvis_vec3 xi = elvis_vec3(point.x, point.y, point.z);
    const uint first = 20u * index;
    elvis_real value;
    elvis_vec3 gradient, x;
    elvis_mat3 jacobian;
    core_results[first] = double(elvis_field_value(point.element, xi, point.component));
    elvis_field_gradient(point.element, xi, point.component, value, gradient);
    core_results[first + 1u] = double(value);
    core_write_vector(first + 2u, gradient);
    core_write_vector(first + 5u, elvis_mapping(point.element, xi));
    elvis_mapping_jacobian(point.element, xi, x, jacobian);
    core_write_vector(first + 8u, x);
    core_write_matrix(first + 11u, jacobian);
}
