// Which part of a strongly bent element a pixel can show. In other elements the points that a pixel shows are surely those that predictions
// lead to; in these, others may lie far from them (element/prediction.glsl).
//
// In a cube of reference coordinates the mapping is linearized at the point xi of the shape that is nearest to its middle. The corners of
// the pixel's part of the surface are predicted from there. No point of the cube is farther than R from xi, so that a point of it that the
// pixel shows is off their hull by C R^2 at most, with the curvature C that is proven at xi (element/local_curvature.glsl). A cube that the
// hull does not reach, enlarged by that, is left out. The others are cut in eight until 4 C R <= 1: in such a cube the mapping is one to one.
//
// What is left is told as one box around all of it: that of the shape where not all has been looked at.

#ifndef CORE_SHOWN_PART
#define CORE_SHOWN_PART

#include "element/local_curvature.glsl"
#include "element/octree_box.glsl"
#include "lines/subpixel.glsl"

// Evaluations in an element, and levels of cubes.
#define CORE_PART_EVALUATIONS 1000u
#define CORE_PART_LEVELS 7u

struct core_shown_part {
    elvis_vec3 lower, upper;
    // False: no curvature is proven of the element.
    bool is_known;
    uint n_evaluations;
};

bool core_is_empty(const core_shown_part part) { return part.is_known && part.lower.x > part.upper.x; }

// Where the hull of the corners lies, as predicted from a point of the element.
struct core_predicted_hull {
    elvis_vec3 lower, upper;
    // The surface there: heights above it are `height` at the point, with this slope in reference coordinates.
    elvis_real height;
    elvis_vec3 slope;
    // Length of the longest step.
    elvis_real step;
};

core_predicted_hull core_predict_hull(const core_element_image image, const core_frame frame, core_cut_square corners, elvis_vec3 normal) {
    const elvis_vec3 origin = image.shift - image.position;
    const elvis_vec3 d0 = core_to_xi(frame, origin + corners.corner0), d1 = core_to_xi(frame, origin + corners.corner1);
    const elvis_vec3 d2 = core_to_xi(frame, origin + corners.corner2), d3 = core_to_xi(frame, origin + corners.corner3);
    core_predicted_hull hull;
    hull.lower = image.xi + min(min(d0, d1), min(d2, d3));
    hull.upper = image.xi + max(max(d0, d1), max(d2, d3));
    hull.slope = elvis_vec3(dot(normal, image.jacobian[0]), dot(normal, image.jacobian[1]), dot(normal, image.jacobian[2]));
    hull.height = -dot(hull.slope, elvis_real(0.25LF) * (d0 + d1 + d2 + d3));
    const elvis_vec3 most = max(max(abs(d0), abs(d1)), max(abs(d2), abs(d3)));
    hull.step = max(max(most.x, most.y), most.z);
    return hull;
}

// Whether the hull, enlarged by `error`, may reach into a cube around `middle`.
bool core_hull_reaches(const core_predicted_hull hull, elvis_vec3 xi, elvis_vec3 middle, elvis_real half_side, elvis_real error) {
    const elvis_vec3 apart = max(hull.lower - middle, middle - hull.upper);
    const elvis_real above = hull.height + dot(hull.slope, middle - xi);
    return max(max(apart.x, apart.y), apart.z) <= half_side + error &&
           abs(above) <= core_model_norm1(hull.slope) * (half_side + error);
}

// `corners`: of the pixel's part of the surface, which is flat but for their error, with this normal.
core_shown_part core_find_part(uint element, core_cut_square corners, elvis_vec3 normal) {
    core_octree_box box = core_whole_box();
    uint n_evaluations = 0u;
    bool is_proven = true;
    elvis_real lower_x = CORE_UNKNOWN, lower_y = CORE_UNKNOWN, lower_z = CORE_UNKNOWN;
    elvis_real upper_x = -CORE_UNKNOWN, upper_y = -CORE_UNKNOWN, upper_z = -CORE_UNKNOWN;
    while (!box.is_last && n_evaluations < CORE_PART_EVALUATIONS) {
        const elvis_vec3 middle = core_middle(box), xi = core_projected(middle);
        const elvis_real half_side = core_half_side(box), reach = core_max_norm(xi - middle) + half_side;
        const core_element_image image = core_element_image_at(element, xi);
        const core_frame frame = core_frame_at(image.position, image.jacobian, corners.error + image.shift_error);
        const core_predicted_hull hull = core_predict_hull(image, frame, corners, normal);
        const elvis_real curvature = core_proven_curvature_at(element, frame);
        // Rounding of positions, and of the inverse.
        const elvis_real rounding = core_max_norm(frame.xi_error) + elvis_real(8) * CORE_ROUNDOFF * frame.conditioning * hull.step;
        const elvis_real error = core_prediction_error_within(curvature, hull.step, reach) + rounding;
        const bool is_sound = frame.is_sound && core_is_finite(hull.step);
        const bool is_beside = core_excess(middle.x, middle.y, middle.z) > CORE_CONSTRAINT_NORM * half_side;
        const bool is_excluded = is_beside || (is_sound && !core_hull_reaches(hull, xi, middle, half_side, error));
        const bool is_single = is_sound && elvis_real(4) * curvature * reach <= elvis_real(1);
        const bool is_kept = !is_excluded && (is_single || box.level >= CORE_PART_LEVELS);
        const elvis_vec3 lower = max(middle - half_side, is_sound ? hull.lower - error : elvis_vec3(-1));
        const elvis_vec3 upper = min(middle + half_side, is_sound ? hull.upper + error : elvis_vec3(1));
        lower_x = is_kept ? min(lower_x, lower.x) : lower_x;
        lower_y = is_kept ? min(lower_y, lower.y) : lower_y;
        lower_z = is_kept ? min(lower_z, lower.z) : lower_z;
        upper_x = is_kept ? max(upper_x, upper.x) : upper_x;
        upper_y = is_kept ? max(upper_y, upper.y) : upper_y;
        upper_z = is_kept ? max(upper_z, upper.z) : upper_z;
        n_evaluations += 1u;
        if (is_excluded || is_kept) {
            core_leave_box(box);
        } else {
            core_cut_box(box);
        }
        is_proven = curvature < CORE_UNKNOWN_CURVATURE;
        if (box.is_last || !is_proven) {
            break;
        }
    }
    const elvis_vec3 lower = box.is_last ? elvis_vec3(lower_x, lower_y, lower_z) : elvis_vec3(-1);
    const elvis_vec3 upper = box.is_last ? elvis_vec3(upper_x, upper_y, upper_z) : elvis_vec3(1);
    return core_shown_part(lower, upper, is_proven, n_evaluations);
}

#endif
