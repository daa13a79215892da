// How the reference coordinates of an element change along a ray, from the linearized mapping alone (element/linearization.glsl): at each
// point of the element as there, but for a share of 2 C R / (1 - 2 C R), with the curvature C (element/prediction.glsl) and the shape's
// radius R. So a ray surely leaves through some faces, if it meets them at all, and surely enters through others. Where the mapping is
// too curved to tell, directions measured of the faces do (segments/face_cone.glsl).
//
// The kernel brings core_elements, core_links and, with CORE_HAS_CURVED, core_cones.

#ifndef CORE_WALK_MOTION
#define CORE_WALK_MOTION

#include "segments/face_cone.glsl"
#include "element/linearization.glsl"
#include "segments/ray_model.glsl"

#ifndef CORE_NO_LINK
#define CORE_NO_LINK 0xffffffffu
#endif
// In the record of core_links, behind the faces.
#ifndef CORE_LINKS_CURVATURE
#define CORE_LINKS_CURVATURE 7u
#endif

// Of a matrix of 16-bit fractions, over the largest entry of a row.
#define CORE_MOTION_MATRIX_ERROR elvis_real(1e-4LF)
// Steepness with which a ray leaves through a face, over that of its coordinates: segments behind edges that are near within rounding are
// then too short to matter.
#define CORE_MOTION_STEEPNESS elvis_real(0.05LF)
// Share by which coordinates may change otherwise: beyond it nothing is told.
#define CORE_MOTION_BEND elvis_real(0.5LF)

// The same against the normals of a face.
#define CORE_CONE_STEEPNESS 0.05

struct core_ray_motion {
    elvis_vec3 slope;
    // Its largest entry, and what that may be off.
    elvis_real size, error;
    bool is_known;
    // Of unit length, in the world.
    vec3 along;
};

core_ray_motion core_motion_along(core_linearization linearization, elvis_real curvature, elvis_vec3 direction) {
    const elvis_real share = elvis_real(2) * curvature * CORE_SHAPE_RADIUS;
    const float scale = max(max(core_scale(linearization.exponents, 0), core_scale(linearization.exponents, 1)),
                            core_scale(linearization.exponents, 2));
    core_ray_motion motion;
    motion.slope = elvis_vec3(core_linear_motion(linearization, vec3(direction)));
    motion.size = core_max_norm(motion.slope);
    motion.error = motion.size * share / (elvis_real(1) - min(share, CORE_MOTION_BEND)) +
                   CORE_MOTION_MATRIX_ERROR * elvis_real(scale) * dot(abs(direction), elvis_vec3(1));
    motion.is_known = linearization.exponents != 0u && share <= CORE_MOTION_BEND;
    motion.along = vec3(direction / length(direction));
    return motion;
}

// By the directions of the face alone; `side`: 1 to leave, -1 to enter.
bool core_surely_crosses(uint element, int face, vec3 along, float side) {
#if CORE_HAS_CURVED
    return core_cone_steepness(elvis_fetch_core_cones(element, uint(face)), along, side) > CORE_CONE_STEEPNESS;
#else
    return false;
#endif
}

bool core_surely_leaves(core_ray_motion motion, uint element, int face) {
    const elvis_vec4 constraint = core_face_constraint(face);
    const elvis_real norm = dot(abs(constraint.xyz), elvis_vec3(1));
    return motion.is_known ? dot(constraint.xyz, motion.slope) - norm * motion.error > CORE_MOTION_STEEPNESS * norm * motion.size
                           : core_surely_crosses(element, face, motion.along, 1.0);
}

bool core_surely_enters(core_ray_motion motion, uint element, int face) {
    const elvis_vec4 constraint = core_face_constraint(face);
    const elvis_real norm = dot(abs(constraint.xyz), elvis_vec3(1));
    return motion.is_known ? dot(constraint.xyz, motion.slope) + norm * motion.error < elvis_real(0)
                           : core_surely_crosses(element, face, motion.along, -1.0);
}

#endif
