// Values and world gradients of a field at reference points: one point an invocation, always in double precision.

layout(local_size_x = 32) in;

struct core_point {
    double x, y, z;
    uint element;
    uint unused;
};

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
// For each point and component: value, then the gradient's three numbers.
layout(set = 0, binding = 1, std430) writeonly buffer core_samples_block { double core_samples[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const uint element = core_points[index].element;
    const elvis_vec3 xi = elvis_vec3(core_points[index].x, core_points[index].y, core_points[index].z);
    const elvis_mat3 to_reference = inverse(elvis_jacobian(element, xi));
    for (uint component = 0u; component < ELVIS_N_COMPONENTS; ++component) {
        elvis_real value;
        elvis_vec3 gradient;
        elvis_field_gradient(element, xi, component, value, gradient);
        // J^-T gradient
        const elvis_vec3 world = gradient * to_reference;
        const uint first = 4u * (index * ELVIS_N_COMPONENTS + component);
        core_samples[first] = value;
        core_samples[first + 1u] = world.x;
        core_samples[first + 2u] = world.y;
        core_samples[first + 3u] = world.z;
    }
}
