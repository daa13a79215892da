// Positions of points of edges, relative to elvis_origin (core/volume/boundary/edge_set.hpp).

layout(local_size_x = 32) in;

layout(set = 0, binding = 0, std430) writeonly buffer core_output { elvis_real core_positions[]; };
// Reference coordinates, three numbers a point.
layout(set = 0, binding = 1, std430) readonly buffer core_input { elvis_real core_points[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_element_block { uint core_edge_elements[]; };
layout(push_constant) uniform core_parameters { uint core_n_edges, core_n_points; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_edges * core_n_points) {
        return;
    }
    const elvis_vec3 xi = elvis_vec3(core_points[3u * index], core_points[3u * index + 1u], core_points[3u * index + 2u]);
    const elvis_vec3 x = elvis_mapping(core_edge_elements[index / core_n_points], xi);
    core_positions[3u * index] = x.x;
    core_positions[3u * index + 1u] = x.y;
    core_positions[3u * index + 2u] = x.z;
}
