// Positions of points of faces, relative to elvis_origin: what the host fits polynomials to (core/volume/boundary/face_fit.hpp).

layout(local_size_x = 32) in;

#include "element/face_frame.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_output { elvis_real core_positions[]; };
// (u, v) for quadrilaterals, then for triangles.
layout(set = 0, binding = 1, std430) readonly buffer core_input { elvis_real core_points[]; };
layout(push_constant) uniform core_parameters { uint core_first, core_n_faces, core_n_points; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_faces * core_n_points) {
        return;
    }
    const uvec4 place = elvis_fetch4_core_faces(core_first + index / core_n_points, 0u);
    const core_face frame = core_face_frame(int(place.y));
    const uint point = index % core_n_points + (frame.is_triangle ? core_n_points : 0u);
    const elvis_real half_one = elvis_real(0.5LF);
    const elvis_real a = (core_points[2u * point] + elvis_real(1)) * half_one;
    const elvis_real b = (core_points[2u * point + 1u] + elvis_real(1)) * half_one;
    const elvis_vec3 x = elvis_mapping(place.x, frame.corner + a * frame.a + b * frame.b);
    core_positions[3u * index] = x.x;
    core_positions[3u * index + 1u] = x.y;
    core_positions[3u * index + 2u] = x.z;
}
