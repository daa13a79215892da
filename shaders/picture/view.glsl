// Rays of the picture; and the cut plane, if there is one. The host prepares both in double precision
// (core/render/cut_surface/cut_plane_geometry.hpp).
//
// Everything is relative to a reference point near what is seen, so that single precision spends its digits
// on differences. Pixel (column, row) has the ray
//     base + t * direction,   base = base0 + (column - column0) * base_column + (row - row0) * base_row,   direction likewise,
// with (column0, row0) in the picture's middle, so that no large terms cancel, base on a plane across the view, and t the distance
// along the view's axis. It meets the cut plane at t = -level / slope, where
// level (signed distance of base from the plane) and slope are linear in column and row, too.

#ifndef CORE_VIEW
#define CORE_VIEW

layout(std140, set = 0, binding = 0) uniform core_view {
    // xyz: base; w: level
    elvis_vec4 core_base0, core_base_column, core_base_row;
    // xyz: direction; w: slope
    elvis_vec4 core_direction0, core_direction_column, core_direction_row;
    // xyz: the reference point; w: distance of base from the eye along the axis of view, so that t + w > 0 in front of the eye.
    elvis_vec4 core_reference;
    // xyz: reference point minus centre of the hierarchies; w: column0.
    elvis_vec4 core_reference_in_hierarchy;
    // xyz: unit normal of the plane; w: row0.
    elvis_vec4 core_plane_normal;
    // x: the depth from which on crossings with surfaces count; y: how far off along its ray a point is that is not undecided, at most;
    // z: signed distance of the hierarchies' centre from the plane, along its normal; w: what rounding of world coordinates makes of it.
    elvis_vec4 core_near;
};

struct core_cut_point {
    // The plane is met from the depth on from which crossings count; nearer to the eye, before or behind it; rounding decides which.
    bool is_hit, is_near, is_doubtful;
    // Along the axis of view, from base.
    elvis_real t;
    // Relative to the reference point.
    elvis_vec3 position;
    elvis_vec3 direction;
    // Bound of the rounding error of position, as a distance off the plane and for locating it.
    elvis_real error;
};

// What the pixels of one column share, and the steps from row to row: read once, because compilers read it again for every row.
struct core_cut_column {
    elvis_vec4 base, base_row, direction, direction_row;
    // Sum of the absolute terms that make up base.
    elvis_vec4 size;
    elvis_real row0, reference_distance;
};

core_cut_column core_cut_begin(elvis_real column) {
    const elvis_real across = column - core_reference_in_hierarchy.w;
    core_cut_column result;
    result.base = core_base0 + across * core_base_column;
    result.direction = core_direction0 + across * core_direction_column;
    result.base_row = core_base_row;
    result.direction_row = core_direction_row;
    result.size = abs(core_base0) + abs(across * core_base_column);
    result.row0 = core_plane_normal.w;
    result.reference_distance = core_reference.w;
    return result;
}

// The ray through a place of the picture, in the middle of a pixel or not: base + t direction.
struct core_cut_ray {
    elvis_vec3 base, direction;
};

core_cut_ray core_cut_ray_at(elvis_real column, elvis_real row) {
    const core_cut_column along = core_cut_begin(column);
    const elvis_real down = row - along.row0;
    return core_cut_ray((along.base + down * along.base_row).xyz, (along.direction + down * along.direction_row).xyz);
}

core_cut_point core_cut_pixel(core_cut_column column, elvis_real row) {
    const elvis_real down = row - column.row0;
    const elvis_vec4 base = column.base + down * column.base_row;
    const elvis_vec4 direction = column.direction + down * column.direction_row;
    core_cut_point point;
    point.t = -base.w / direction.w;
    point.direction = direction.xyz;
    point.position = base.xyz + point.t * direction.xyz;
    // Rounding of numbers of these sizes: the terms of base and the product; and those of the level, which the slope makes a
    // distance along the ray.
    const elvis_vec4 terms = column.size + abs(down * column.base_row);
    const elvis_real from_eye = point.t + column.reference_distance, stretch = length(direction.xyz), least = core_near.x / stretch;
    // The slope's terms are as large as the direction.
    const elvis_real along_ray =
        CORE_ROUNDOFF * (elvis_real(4) * terms.w + elvis_real(8) * stretch * abs(point.t)) / abs(direction.w);
    point.is_hit = direction.w != elvis_real(0) && from_eye > least;
    point.is_near = direction.w != elvis_real(0) && abs(from_eye) <= least;
    point.is_doubtful = direction.w != elvis_real(0) && abs(from_eye - least) <= along_ray;
    // In units of roundoff: base and direction lose four each, of their terms; the quotient t, by which Vulkan lets a division lose five,
    // what the level and the slope lose, too; the product and the sum one each.
    const elvis_real of_t = (elvis_real(4) * terms.w + elvis_real(4) * stretch * abs(point.t)) / abs(direction.w) + elvis_real(10) * abs(point.t);
    const elvis_vec3 size = elvis_real(5) * terms.xyz + of_t * abs(direction.xyz);
    point.error = CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    return point;
}

// A square of the picture; in pixels, the middles of which are at whole numbers.
struct core_picture_square {
    elvis_real column, row, half_size;
};

// The corners of a square of the picture on the plane.
struct core_cut_square {
    elvis_vec3 corner0, corner1, corner2, corner3;
    // Whether the rays through all of them, or through any or any between them, meet the plane in front of the eye.
    bool all_hit, any_hit;
    elvis_real error;
};

// Whether the plane is seen between four places of the picture. The reciprocal of its distance from the eye is linear there: near corners
// and others may have it between them.
bool core_is_any_hit(core_cut_point p0, core_cut_point p1, core_cut_point p2, core_cut_point p3) {
    const bool any_near = p0.is_near || p1.is_near || p2.is_near || p3.is_near;
    const bool all_near = p0.is_near && p1.is_near && p2.is_near && p3.is_near;
    return p0.is_hit || p1.is_hit || p2.is_hit || p3.is_hit || (any_near && !all_near);
}

core_cut_square core_cut_corners(core_picture_square place) {
    const core_cut_column left = core_cut_begin(place.column - place.half_size);
    const core_cut_column right = core_cut_begin(place.column + place.half_size);
    const elvis_real upper = place.row - place.half_size, lower = place.row + place.half_size;
    const core_cut_point p0 = core_cut_pixel(left, upper), p1 = core_cut_pixel(right, upper);
    const core_cut_point p2 = core_cut_pixel(left, lower), p3 = core_cut_pixel(right, lower);
    core_cut_square square;
    square.corner0 = p0.position;
    square.corner1 = p1.position;
    square.corner2 = p2.position;
    square.corner3 = p3.position;
    square.all_hit = p0.is_hit && p1.is_hit && p2.is_hit && p3.is_hit;
    square.any_hit = core_is_any_hit(p0, p1, p2, p3);
    square.error = max(max(p0.error, p1.error), max(p2.error, p3.error));
    return square;
}

#endif
