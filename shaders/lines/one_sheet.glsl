// Whether a face that faces the viewer at two points does so in one piece. If not, the one point lies behind a silhouette of the face
// itself.

#ifndef CORE_ONE_SHEET
#define CORE_ONE_SHEET

#include "element/element_frame.glsl"
#include "element/face_frame.glsl"
#include "element/shape_region.glsl"

// Points between two of a face at which is looked whether it turns away between them.
#define CORE_SHEET_SAMPLES 4

// Whether the face is in one piece, as seen in this direction, from one of its points to another: it turns away at no sample between them.
// A fold that is narrower is missed.
bool core_is_one_sheet(uint element, int own_face, elvis_vec3 from, elvis_vec3 to, elvis_vec3 direction, bool enters) {
    bool is_one = true;
    for (int i = 1; i <= CORE_SHEET_SAMPLES; ++i) {
        const elvis_vec3 xi = from + (elvis_real(i) / elvis_real(CORE_SHEET_SAMPLES + 1)) * (to - from);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, xi, position, jacobian);
        const core_frame frame = core_frame_at(position, core_full_jacobian(jacobian), elvis_real(0));
        const elvis_real slope = dot(core_face_constraint(own_face).xyz, core_to_xi(frame, direction));
        is_one = is_one && frame.is_sound && (slope < elvis_real(0)) == enters;
    }
    return is_one;
}

#endif
