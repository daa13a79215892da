// Value and world gradient of an expression at reference points: one point an invocation, always in double precision.

layout(local_size_x = 32) in;

struct core_point {
    double x, y, z;
    uint element;
    uint unused;
};

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_samples_block { double core_samples[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_points) {
        return;
    }
    const uint element = core_points[index].element;
    const elvis_vec3 xi = elvis_vec3(core_points[index].x, core_points[index].y, core_points[index].z);
    elvis_real value;
    elvis_vec3 gradient;
    core_shown_gradient(element, xi, value, gradient);
    // J^-T gradient
    const elvis_vec3 world = gradient * inverse(elvis_jacobian(element, xi));
    core_samples[4u * index] = value;
    core_samples[4u * index + 1u] = world.x;
    core_samples[4u * index + 2u] = world.y;
    core_samples[4u * index + 3u] = world.z;
}
