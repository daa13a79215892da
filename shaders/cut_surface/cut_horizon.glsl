// Where the horizon of the plane crosses a square of the picture: whether all that is seen of the plane there lies behind the volume.
//
// In perspective the reciprocal of the distance at which a ray meets the plane, along the axis of view, is linear in the picture. So the
// plane is nowhere nearer in the square than at one of its corners.
//
// The kernel brings picture/view.glsl and tiles/hierarchy.glsl.

// Of the volume's bounds, for rounding of what is compared.
#define CORE_HORIZON_MARGIN elvis_real(1e-3LF)

// Distance along the axis of view within which all of the volume lies; no number without perspective.
elvis_real core_volume_end() {
    // Across the axis of view and each other; zero without perspective.
    const elvis_vec3 right = core_direction_column.xyz, down = core_direction_row.xyz, towards = core_direction0.xyz;
    const elvis_real right_square = dot(right, right), down_square = dot(down, down);
    const elvis_vec3 axis = towards - dot(towards, right) / right_square * right - dot(towards, down) / down_square * down;
    const core_node root = core_fetch_node(0u);
    const elvis_vec3 middle = elvis_vec3(0.5 * (root.lower + root.upper)) - core_reference_in_hierarchy.xyz;
    const elvis_vec3 half_size = elvis_vec3(0.5 * (root.upper - root.lower));
    const elvis_real depth = dot(half_size, abs(axis)), farthest = dot(middle, axis) + depth + core_reference.w;
    return farthest + CORE_HORIZON_MARGIN * (depth + abs(farthest));
}

elvis_real core_cut_distance(core_cut_point corner) {
    return corner.is_hit || corner.is_near ? corner.t + core_reference.w : elvis_real(3e38LF);
}

// `corner0` to `corner3`: rays through the square's corners, some of which do not meet the plane. False if the end is no number.
bool core_is_behind_volume(core_cut_point corner0, core_cut_point corner1, core_cut_point corner2, core_cut_point corner3,
                           elvis_real volume_end) {
    return min(min(core_cut_distance(corner0), core_cut_distance(corner1)), min(core_cut_distance(corner2), core_cut_distance(corner3))) >
           volume_end;
}

bool core_is_square_behind_volume(core_picture_square place, elvis_real volume_end) {
    const core_cut_column left = core_cut_begin(place.column - place.half_size);
    const core_cut_column right = core_cut_begin(place.column + place.half_size);
    const elvis_real upper = place.row - place.half_size, lower = place.row + place.half_size;
    return core_is_behind_volume(core_cut_pixel(left, upper), core_cut_pixel(right, upper), core_cut_pixel(left, lower),
                                 core_cut_pixel(right, lower), volume_end);
}
