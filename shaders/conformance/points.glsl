// The points at which kernels of this room look at a snippet, and where their results stand.

struct core_point {
    double x, y, z;
    uint element;
    uint component;
};

layout(set = 0, binding = 0, std430) readonly buffer core_points_block { core_point core_points[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_results_block { double core_results[]; };
layout(push_constant) uniform core_parameters { uint core_n_points; };

void core_write_vector(uint first, elvis_vec3 v) {
    core_results[first] = double(v.x);
    core_results[first + 1u] = double(v.y);
    core_results[first + 2u] = double(v.z);
}

// Column by column.
void core_write_matrix(uint first, elvis_mat3 m) {
    core_write_vector(first, m[0]);
    core_write_vector(first + 3u, m[1]);
    core_write_vector(first + 6u, m[2]);
}
