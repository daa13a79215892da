// The point that a pixel sees at a depth, relative to the reference point; the direction of its ray, of any length, and the
// parameter of the ray there. `place`: column and row.
//
// The kernel brings picture/view.glsl.

elvis_vec3 core_seen_point(elvis_vec2 place, elvis_real depth, out elvis_vec3 direction, out elvis_real t) {
    const core_cut_column column = core_cut_begin(place.x);
    const elvis_real down = place.y - column.row0;
    direction = (column.direction + down * column.direction_row).xyz;
    t = depth / length(direction) - column.reference_distance;
    return (column.base + down * column.base_row).xyz + t * direction;
}
