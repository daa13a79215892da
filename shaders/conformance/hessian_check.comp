// Second derivatives that an instance gives, or gets by differences, at chosen reference points. Needs a device with float64.
//
// 52 numbers a point: value, gradient and hessian of elvis_field_hessian; position, Jacobian and three hessians of
// elvis_mapping_hessian; matrices column by column.

layout(local_size_x = 8) in;

#include "conformance/points.glsl"

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const core_point point = core_points[index];
    const elvis_vec3 xi = elvis_vec3(point.x, point.y, point.z);
    const uint first = 52u * index;
    elvis_real value;
    elvis_vec3 gradient, x;
    elvis_mat3 hessian, jacobian, hessian_x, hessian_y, hessian_z;
    elvis_field_hessian(point.element, xi, point.component, value, gradient, hessian);
    elvis_mapping_hessian(point.element, xi, x, jacobian, hessian_x, hessian_y, hessian_z);
    core_results[first] = double(value);
    core_write_vector(first + 1u, gradient);
    core_write_matrix(first + 4u, hessian);
    core_write_vector(first + 13u, x);
    core_write_matrix(first + 16u, jacobian);
    core_write_matrix(first + 25u, hessian_x);
    core_write_matrix(first + 34u, hessian_y);
    core_write_matrix(first + 43u, hessian_z);
}
