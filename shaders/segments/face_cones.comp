// The directions of the faces of each element of a class (segments/face_cone.glsl): once for a volume.

layout(local_size_x = 32) in;

#include "element/element_frame.glsl"
#include "segments/face_cone.glsl"
#include "element/face_frame.glsl"
#include "element/shape_region.glsl"

layout(std430, set = 0, binding = 0) writeonly buffer core_output {
    // Eight words an element, one for each face.
    uint core_words[];
};

layout(push_constant) uniform core_constants {
    uint core_first_element;
    uint core_n_elements;
};

// Normals are measured at points. The factor is for those between them.
const float core_cone_safety = 2.0;
// Above it nothing is known.
const float core_widest_cone = 1.5;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const core_face frame = core_face_frame(face);
        const elvis_vec3 outward = core_face_constraint(face).xyz;
        vec3 axis = vec3(0);
        float widest = 0.0;
        // The middle, then corners and middles of edges; of triangles the last corner several times.
        for (int k = 0; k < 9; ++k) {
            const int place = k == 0 ? 4 : k <= 4 ? k - 1 : k;
            const elvis_real s = elvis_real(0.5LF) * elvis_real(place % 3), r = elvis_real(0.5LF) * elvis_real(place / 3);
            const elvis_vec3 xi = frame.corner + (frame.is_triangle ? s * (elvis_real(1) - r) : s) * frame.a + r * frame.b;
            elvis_vec3 position;
            elvis_mat3 jacobian;
            elvis_mapping_jacobian(core_first_element + i, xi, position, jacobian);
            const core_frame here = core_frame_at(position, jacobian, elvis_real(0));
            // The gradient of the face's constraint in the world.
            const elvis_vec3 gradient = outward.x * here.row0 + outward.y * here.row1 + outward.z * here.row2;
            const elvis_real size = length(gradient);
            const bool is_sound = here.is_sound && core_is_finite(size) && size > elvis_real(0);
            const vec3 normal = is_sound ? vec3(gradient / size) : vec3(0);
            axis = k == 0 ? normal : axis;
            widest = max(widest, is_sound ? acos(clamp(dot(axis, normal), -1.0, 1.0)) : core_widest_cone);
        }
        const float angle = core_cone_safety * widest;
        core_words[8u * i + uint(face)] = core_pack_cone(axis, angle < core_widest_cone ? sin(angle) : 1.0);
    }
}
