// Second derivatives that an instance gives, or gets by differences, at chosen reference points. Needs a device with float64.

layout(local_size_x = 8) in;

struct core_point {
    double x, y, z;
    uint element;
    uint component;
};

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
// 52 numbers a point: value, gradient and hessian of elvis_field_hessian; position, Jacobian and three hessians of
// elvis_mapping_hessian; matrices column by column.
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { double core_results[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void core_write(uint first, elvis_mat3 matrix) {
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            core_results[first + 3u * uint(j) + uint(i)] = double(matrix[j][i]);
        }
    }
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const uint element = core_points[index].element;
    const elvis_vec3 xi = elvis_vec3(core_points[index].x, core_points[index].y, core_points[index].z);
    const uint first = 52u * index;
    elvis_real value;
    elvis_vec3 gradient, x;
    elvis_mat3 hessian, jacobian, hessian_x, hessian_y, hessian_z;
    elvis_field_hessian(element, xi, core_points[index].component, value, gradient, hessian);
    elvis_mapping_hessian(element, xi, x, jacobian, hessian_x, hessian_y, hessian_z);
    core_results[first] = double(value);
    for (int i = 0; i < 3; ++i) {
        core_results[first + 1u + uint(i)] = double(gradient[i]);
        core_results[first + 13u + uint(i)] = double(x[i]);
    }
    core_write(first + 4u, hessian);
    core_write(first + 16u, jacobian);
    core_write(first + 25u, hessian_x);
    core_write(first + 34u, hessian_y);
    core_write(first + 43u, hessian_z);
}
