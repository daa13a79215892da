// Whether a box of the hierarchy meets the cut plane: a tile's or a pixel's share of an oblique plane has a box that meets elements
// far off the plane. They are never looked at, so that a picture does not depend on whether they are there.
//
// The kernel brings picture/view.glsl and tiles/hierarchy.glsl.

bool core_meets_plane(core_node node) {
    const vec3 normal = abs(vec3(core_plane_normal.xyz));
    const vec3 middle = 0.5 * (node.lower + node.upper), half_size = 0.5 * (node.upper - node.lower);
    const float level = float(core_near.z);
    const float distance = abs(level + dot(vec3(core_plane_normal.xyz), middle)), reach = dot(normal, half_size);
    // Of the sums, and of what makes them up: fewer than 16 roundings.
    const float rounding = 16.0 * CORE_FLOAT_ROUNDOFF * (abs(level) + dot(normal, abs(middle) + half_size));
    return distance <= reach + rounding + float(core_near.w);
}
