// Everything that a snippet gives, at chosen reference points: what plugins are checked with. Needs a device with float64.

layout(local_size_x = 8) in;

struct core_point {
    double x, y, z;
    uint element;
    uint component;
};

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
// 20 numbers a point: elvis_field_value; value and gradient of elvis_field_gradient; elvis_mapping; position and Jacobian (columns) of
// elvis_mapping_jacobian.
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { double core_results[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const uint element = core_points[index].element;
    const uint component = core_points[index].component;
    const elvis_vec3 xi = elvis_vec3(core_points[index].x, core_points[index].y, core_points[index].z);
    const uint first = 20u * index;

    core_results[first] = double(elvis_field_value(element, xi, component));
    elvis_real value;
    elvis_vec3 gradient;
    elvis_field_gradient(element, xi, component, value, gradient);
    core_results[first + 1u] = double(value);
    const elvis_vec3 position = elvis_mapping(element, xi);
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    for (int i = 0; i < 3; ++i) {
        core_results[first + 2u + i] = double(gradient[i]);
        core_results[first + 5u + i] = double(position[i]);
        core_results[first + 8u + i] = double(x[i]);
        for (int j = 0; j < 3; ++j) {
            core_results[first + 11u + 3 * j + i] = double(jacobian[j][i]);
        }
    }
}
