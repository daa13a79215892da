// Geometry of one cut plane in one picture, prepared by the host in double precision (core/render/cut_plane_geometry.hpp).
//
// Everything is relative to a reference point near the part of the plane that is seen, so that single precision spends its digits on
// differences. Pixel (column, row) has the ray
//     base + t * direction,   base = base0 + column * base_column + row * base_row,   direction likewise,
// with base on a plane across the view and t the distance along the view's axis. It meets the cut plane at t = -level / slope, where
// level (signed distance of base from the plane) and slope are linear in column and row, too.

layout(std140, set = 0, binding = 0) uniform core_cut_frame {
    // xyz: base; w: level
    elvis_vec4 core_base0, core_base_column, core_base_row;
    // xyz: direction; w: slope
    elvis_vec4 core_direction0, core_direction_column, core_direction_row;
    // xyz: the reference point; w: distance of base from the eye along the axis of view, so that t + w > 0 in front of the eye.
    elvis_vec4 core_reference;
    // xyz: reference point minus centre of the hierarchies.
    elvis_vec4 core_reference_in_hierarchy;
    // xyz: unit normal of the plane.
    elvis_vec4 core_plane_normal;
};

struct core_cut_point {
    bool is_hit;
    // Along the axis of view, from base.
    elvis_real t;
    // Relative to the reference point.
    elvis_vec3 position;
    elvis_vec3 direction;
    // Bound of the rounding error of position, as a distance off the plane and for locating it.
    elvis_real error;
};

core_cut_point core_cut_pixel(elvis_real column, elvis_real row) {
    const elvis_vec4 base = core_base0 + column * core_base_column + row * core_base_row;
    const elvis_vec4 direction = core_direction0 + column * core_direction_column + row * core_direction_row;
    core_cut_point point;
    point.t = -base.w / direction.w;
    point.is_hit = direction.w != elvis_real(0) && point.t + core_reference.w > elvis_real(0);
    point.direction = direction.xyz;
    point.position = base.xyz + point.t * direction.xyz;
    // Four roundings of numbers of these sizes: the three terms of base, and the product.
    const elvis_vec3 size = abs(base.xyz) + abs(point.t * direction.xyz);
    point.error = elvis_real(4) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    return point;
}
