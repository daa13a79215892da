// The directions and curvatures of the faces of each element of a class (segments/face_cone.glsl): once for a volume.

layout(local_size_x = 32) in;

#include "element/element_frame.glsl"
#include "segments/face_cone.glsl"
#include "element/face_frame.glsl"
#include "element/shape_region.glsl"

layout(std430, set = 0, binding = 0) writeonly buffer core_output {
    // Eight words an element: one for each face, and two for curvatures.
    uint core_words[];
};

layout(push_constant) uniform core_constants {
    uint core_first_element;
    uint core_n_elements;
};

// Normals are measured at points. The factor is for those between them.
const float core_cone_safety = 2.0;
const elvis_real core_bend_safety = elvis_real(2);
// Above it nothing is known.
const float core_widest_cone = 1.5;

// How much tangents change, in a frame.
elvis_real core_turn(core_frame frame, elvis_mat3 change) {
    return core_max_norm(abs(core_to_xi(frame, change[0])) + abs(core_to_xi(frame, change[1])));
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    uvec2 curvatures = uvec2(0u);
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const core_face frame = core_face_frame(face);
        const elvis_vec3 outward = core_face_constraint(face).xyz;
        vec3 axis = vec3(0);
        float widest = 0.0;
        elvis_real steepest = elvis_real(0), middle_s, middle_r;
        elvis_mat3 middle;
        core_frame middle_frame;
        // The middle, then corners and middles of edges; of triangles the last corner several times.
        for (int k = 0; k < 9; ++k) {
            const int place = k == 0 ? 4 : k <= 4 ? k - 1 : k;
            const elvis_real s = elvis_real(0.5LF) * elvis_real(place % 3), r = elvis_real(0.5LF) * elvis_real(place / 3);
            const elvis_real on_a = frame.is_triangle ? s * (elvis_real(1) - r) : s;
            const elvis_vec3 xi = frame.corner + on_a * frame.a + r * frame.b;
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
            const elvis_mat3 tangents = core_face_tangents(frame, jacobian);
            const core_frame tangent_frame = core_frame_at(position, tangents, elvis_real(0));
            if (k == 0) {
                middle = tangents;
                middle_frame = tangent_frame;
                middle_s = on_a;
                middle_r = r;
            } else {
                const elvis_mat3 turn = elvis_mat3(tangents[0] - middle[0], tangents[1] - middle[1], elvis_vec3(0));
                const elvis_real distance = max(abs(on_a - middle_s), abs(r - middle_r));
                const elvis_real size = max(core_turn(tangent_frame, turn), core_turn(middle_frame, turn)) / distance;
                const bool is_known = tangent_frame.is_sound && middle_frame.is_sound && core_is_finite(size);
                steepest = is_known ? max(steepest, size) : elvis_real(1e30LF);
            }
        }
        const float angle = core_cone_safety * widest;
        core_words[8u * i + uint(face)] = core_pack_cone(axis, angle < core_widest_cone ? sin(angle) : 1.0);
        const uint curvature = core_pack_face_curvature(float(core_bend_safety * elvis_real(0.5LF) * steepest), face);
        curvatures.x |= face < 3 ? curvature : 0u;
        curvatures.y |= face < 3 ? 0u : curvature;
    }
    core_words[8u * i + CORE_CONE_CURVATURES] = curvatures.x;
    core_words[8u * i + CORE_CONE_CURVATURES + 1u] = curvatures.y;
}
