// What one element has to do with a subpixel: with what a square of the picture shows of a surface.
//
// The surface is flat between the subpixel's corners, so that every point of the subpixel lies in their hull. The mapping is linearized at
// a point xi of the element. A point x of subpixel and element has the offset J^-1 (x - x(xi)) from xi but for the error of a Newton step
// (element/prediction.glsl) and rounding: the region of arithmetic/model.glsl. Faces are linear in reference coordinates, so where the
// corners lie tells what the boundary of the element does in the subpixel:
//
//   inside    all of the subpixel lies in the element
//   outside   none of it does
//   crossed   one corner lies inside, another one outside: the boundary runs through between them, since a subpixel is in one piece
//
// and otherwise it is open. Faces in which the surface lies do not bound anything on it: they are left out.

#ifndef CORE_SUBPIXEL
#define CORE_SUBPIXEL

#include "element/element_frame.glsl"
#include "element/face_frame.glsl"
#include "element/local_curvature.glsl"
#include "picture/view.glsl"
#include "element/inside.glsl"
#include "arithmetic/model.glsl"
#include "element/prediction.glsl"
#include "element/shape_region.glsl"

// The mapping, linearized at a point, for what lies relative to the picture's reference point.
struct core_element_image {
    uint element;
    elvis_vec3 xi;
    // Relative to elvis_origin.
    elvis_vec3 position;
    elvis_mat3 jacobian;
    // From elvis_origin to the reference point, and rounding of that.
    elvis_vec3 shift;
    elvis_real shift_error;
    // element/prediction.glsl
    elvis_real curvature;
#if CORE_STRONGLY_BENT
    // The element may fold back.
    bool may_fold;
    // No point of the element that the pixel shows is farther from xi (lines/shown_part.glsl); negative where that is not known.
    elvis_real farthest;
#endif
};

core_element_image core_element_image_at(uint element, elvis_vec3 xi) {
    core_element_image image;
    image.element = element;
    image.xi = xi;
    elvis_mapping_jacobian(element, xi, image.position, image.jacobian);
    image.jacobian = core_full_jacobian(image.jacobian);
    image.shift = core_reference.xyz - elvis_origin(element);
    image.shift_error = CORE_ROUNDOFF * max(max(abs(image.shift.x), abs(image.shift.y)), abs(image.shift.z));
    image.curvature = elvis_fetch_core_curvatures(element, 0u);
#if CORE_STRONGLY_BENT
    image.may_fold = image.curvature > CORE_MOST_MEASURED_CURVATURE;
    image.farthest = elvis_real(-1);
    image.curvature = core_curvature_at(element, core_frame_at(image.position, image.jacobian, elvis_real(0)), image.curvature);
#endif
    return image;
}

// How far off predictions are, of points that are predicted within `step`.
elvis_real core_image_error(const core_element_image image, elvis_real step) {
#if CORE_STRONGLY_BENT
    if (image.farthest >= elvis_real(0)) {
        return core_prediction_error_within(image.curvature, step, image.farthest);
    }
#endif
    return core_prediction_error(image.curvature, step);
}

struct core_subpixel {
    core_region region;
    bool is_inside, is_outside, is_crossed;
    // Bits of the corners that lie inside, and outside.
    uint inside_corners, outside_corners;
    // The surface lies in a face of the element, which is on the far side. It may do so, as far as is known from here. It does or may do
    // so, and the element is on the near side.
    bool is_behind, may_be_behind, is_before;
    // The surface touches the element along an edge at most, within rounding, and does not show it.
    bool is_grazed;
    // By how much at least the corners violate a face together, or leave the surface's own one, as predicted; negative if they do
    // not.
    elvis_real clearance;
    // Length of the predicted step to the middle of the corners, and that point.
    elvis_real step;
    elvis_vec3 middle;
};

// Sine of the angle between surface and face below which the face may lie in the surface, if it also lies there within rounding.
#define CORE_COPLANAR elvis_real(1e-4LF)

// In place of the index of a face within an element.
#define CORE_NO_FACE -1

// Where a surface touches an element along an edge only, corners straddle two faces or more. For each of these faces, take a corner's
// distance beyond it, divided by the face's range over the corners. In the element the mean over these faces is negative. If it is
// negative at no corner, but for rounding, the surface only touches the edge. One face is no edge: along the border of the volume there
// may be no other element to tell its line. A subpixel that is not this many times as wide as the rounding, at extreme magnification,
// stays open.
#define CORE_GRAZE_SPAN elvis_real(64)

uint core_bits(bvec4 b) { return uint(b.x) | uint(b.y) << 1 | uint(b.z) << 2 | uint(b.w) << 3; }
elvis_real core_least(elvis_vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
elvis_real core_most(elvis_vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Of a linear function with this value at xi.
elvis_vec4 core_at_corners(core_region region, elvis_real value, elvis_vec3 slope) {
    return elvis_vec4(value + dot(slope, region.corner0), value + dot(slope, region.corner1), value + dot(slope, region.corner2),
                      value + dot(slope, region.corner3));
}

// What the faces of the element say about the region of `subpixel` around xi. `own_face`: the face in which the surface lies by
// definition; CORE_NO_FACE if it is any surface, which then has this normal.
void core_judge_faces(inout core_subpixel subpixel, elvis_vec3 xi, const core_frame frame, elvis_vec3 plane_normal, elvis_vec3 direction,
                      int own_face) {
    const core_region region = subpixel.region;
    // Rounding of the corners' coordinates.
    const elvis_vec3 xi_error = frame.xi_error;
    subpixel.is_inside = true;
    subpixel.is_outside = subpixel.is_behind = subpixel.may_be_behind = subpixel.is_before = false;
    subpixel.inside_corners = 15u;
    subpixel.outside_corners = 0u;
    subpixel.clearance = -CORE_UNKNOWN;
    elvis_vec4 beyond = elvis_vec4(0);
    elvis_real blur = elvis_real(0);
    bool is_wide = own_face < 0;
    uint n_straddled = 0u;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_vec4 g = core_at_corners(region, dot(constraint.xyz, xi) + constraint.w, constraint.xyz);
        const elvis_real slack = core_model_norm1(constraint.xyz) * (region.beyond + elvis_real(8) * CORE_ROUNDOFF);
        const elvis_real rounding = dot(abs(constraint.xyz), xi_error);
        const elvis_real lowest = core_least(g) - slack, highest = core_most(g) + slack;
        // The face's normal in the world is J^-T times that in xi.
        const elvis_vec3 normal = constraint.x * frame.row0 + constraint.y * frame.row1 + constraint.z * frame.row2;
        const elvis_vec3 across = cross(normal, plane_normal);
        const bool is_parallel = dot(across, across) <= CORE_COPLANAR * CORE_COPLANAR * dot(normal, normal);
        const bool is_reached = lowest <= elvis_real(0) && highest >= elvis_real(0);
        const bool coincides =
            is_parallel && is_reached && highest - lowest <= elvis_real(2) * slack + elvis_real(4) * rounding;
        const bool lies_in = own_face >= 0 ? face == own_face : coincides;
        const bool is_far_side = lies_in && own_face < 0 && dot(normal, direction) < elvis_real(0);
        // Far from the point of the element, a strongly curved mapping lets any parallel plane coincide within the error.
        const bool is_in_plane = max(core_most(g), -core_least(g)) <= elvis_real(4) * rounding;
        subpixel.is_behind = subpixel.is_behind || (is_far_side && is_in_plane);
        subpixel.may_be_behind = subpixel.may_be_behind || (is_far_side && !is_in_plane);
        subpixel.is_before = subpixel.is_before || (lies_in && !is_far_side);
        subpixel.is_inside = subpixel.is_inside && (lies_in || highest <= elvis_real(0));
        subpixel.is_outside = subpixel.is_outside || (!lies_in && lowest > elvis_real(0));
        subpixel.inside_corners &= lies_in ? 15u : core_bits(lessThan(g, elvis_vec4(-slack)));
        subpixel.outside_corners |= lies_in ? 0u : core_bits(greaterThan(g, elvis_vec4(slack)));
        const elvis_real span = highest - lowest - elvis_real(2) * slack;
        const bool is_straddled = !lies_in && is_reached;
        const elvis_real weight = is_straddled ? elvis_real(1) / span : elvis_real(0);
        is_wide = is_wide && (!is_straddled || span >= CORE_GRAZE_SPAN * rounding);
        beyond += weight * g;
        blur += weight * rounding;
        n_straddled += is_straddled ? 1u : 0u;
        const elvis_real above = core_least(g) - rounding, below = -core_most(g) - rounding;
        // A surface that is the element's own face runs neither beyond nor before it.
        const elvis_real clearance = lies_in ? (own_face >= 0 ? max(above, below) : -CORE_UNKNOWN) : above;
        subpixel.clearance = max(subpixel.clearance, clearance);
    }
    const bool is_exact = region.beyond <= elvis_real(4) * max(max(xi_error.x, xi_error.y), xi_error.z);
    subpixel.is_grazed = is_wide && is_exact && n_straddled >= 2u && core_least(beyond) >= -blur;
    subpixel.is_crossed = subpixel.inside_corners != 0u && subpixel.outside_corners != 0u;
}

#if ELVIS_HAS_INSIDE
// What the element's own boundary says, beside the faces.
void core_judge_inside(inout core_subpixel subpixel, uint element, elvis_vec3 xi) {
    const core_region region = subpixel.region;
    const core_inside inside = core_inside_at(element, xi);
    const elvis_real slack = core_model_norm1(inside.slope) * (region.beyond + elvis_real(8) * CORE_ROUNDOFF) + inside.rounding +
                             core_inside_bend(inside, region.radius);
    const elvis_vec4 g = core_at_corners(region, inside.value, inside.slope);
    subpixel.inside_corners &= core_bits(lessThan(g, elvis_vec4(-slack)));
    subpixel.outside_corners |= core_bits(greaterThan(g, elvis_vec4(slack)));
    const bool is_sound = core_is_finite(g.x + g.y + g.z + g.w + slack);
    subpixel.is_inside = subpixel.is_inside && is_sound && core_most(g) + slack <= elvis_real(0);
    subpixel.is_outside = subpixel.is_outside || (is_sound && core_least(g) - slack > elvis_real(0));
    subpixel.is_crossed = is_sound && subpixel.inside_corners != 0u && subpixel.outside_corners != 0u;
}
#endif

// `corners`: of a part of the surface that is flat but for their error, around a point with this normal, seen in this direction.
// `own_face`: as in core_judge_faces.
core_subpixel core_subpixel_at(const core_element_image image, core_frame frame, core_cut_square corners, elvis_vec3 normal,
                               elvis_vec3 direction, int own_face) {
    core_subpixel subpixel;
    const elvis_vec3 origin = image.shift - image.position;
    const elvis_vec3 d0 = core_to_xi(frame, origin + corners.corner0), d1 = core_to_xi(frame, origin + corners.corner1);
    const elvis_vec3 d2 = core_to_xi(frame, origin + corners.corner2), d3 = core_to_xi(frame, origin + corners.corner3);
    const elvis_vec3 most = max(max(abs(d0), abs(d1)), max(abs(d2), abs(d3)));
    const elvis_real largest_step = max(max(most.x, most.y), most.z);
    const elvis_real rounding = max(max(frame.xi_error.x, frame.xi_error.y), frame.xi_error.z);
    const elvis_real beyond = core_image_error(image, largest_step) + rounding;
    subpixel.region = core_region(d0, d1, d2, d3, beyond, largest_step + beyond);
    subpixel.middle = image.xi + elvis_real(0.25LF) * (d0 + d1 + d2 + d3);
    const elvis_vec3 to_middle = abs(subpixel.middle - image.xi);
    subpixel.step = max(max(to_middle.x, to_middle.y), to_middle.z);
    core_judge_faces(subpixel, image.xi, frame, normal, direction, own_face);
    const bool is_sound = frame.is_sound && core_is_finite(largest_step);
    subpixel.is_inside = subpixel.is_inside && is_sound;
    subpixel.is_outside = subpixel.is_outside && is_sound;
    subpixel.is_crossed = subpixel.is_crossed && is_sound;
    subpixel.is_grazed = subpixel.is_grazed && is_sound;
#if ELVIS_HAS_INSIDE
    core_judge_inside(subpixel, image.element, image.xi);
#endif
    return subpixel;
}

// How the subpixel lies to the point at which the mapping is linearized.
struct core_approach {
    // Another point of the element is so much nearer to the subpixel that more would be known from there.
    bool is_far;
    // The subpixel lies outside although the bound, which says nothing far away from a curved element, does not show it. The prediction's
    // nearest element point is almost the point it was made from, and the subpixel is beyond a face by much more than their distance. Only
    // an element that folds back could still meet the surface elsewhere: some of a curvature of 8 did.
    bool is_clear;
};

core_approach core_approach_to(const core_subpixel subpixel, const core_element_image image) {
    const elvis_real radius = abs(subpixel.region.radius - subpixel.region.beyond - subpixel.step);
    elvis_real x = subpixel.middle.x, y = subpixel.middle.y, z = subpixel.middle.z;
    core_project(x, y, z);
    const elvis_real move = max(max(abs(x - image.xi.x), abs(y - image.xi.y)), abs(z - image.xi.z));
    core_approach approach;
    approach.is_far = move > elvis_real(0.25LF) * radius && move > elvis_real(16) * CORE_ROUNDOFF;
    approach.is_clear = !approach.is_far && subpixel.clearance > elvis_real(0.5LF) * radius + elvis_real(8) * move;
#if CORE_STRONGLY_BENT
    approach.is_clear = approach.is_clear && !image.may_fold;
#endif
    return approach;
}

#endif
