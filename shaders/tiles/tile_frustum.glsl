// The rays of a rectangle of pixels, all together. The kernel brings picture/view.glsl and tiles/hierarchy.glsl.

#ifndef CORE_TILE_FRUSTUM
#define CORE_TILE_FRUSTUM

// They lie between four planes; each is given by a point, its normal inwards, and the sizes of both for rounding.
struct core_frustum {
    // Relative to base, which all planes are near.
    vec3 left, right, top, bottom;
    vec3 at_left, at_right, at_top, at_bottom;
    vec3 axis;
    float axis_offset, eye_t;
    // The rays at the corners, relative to the reference point.
    vec3 origins[4], directions[4];
};

bool core_is_beyond(core_node node, vec3 normal, vec3 point) {
    const vec3 farthest = mix(node.lower, node.upper, greaterThan(normal, vec3(0)));
    const vec3 sizes = max(abs(node.lower), abs(node.upper)) + abs(point);
    const float rounding = 16.0 * CORE_FLOAT_ROUNDOFF * max(max(sizes.x, sizes.y), sizes.z);
    return dot(normal, farthest - point) < -rounding * dot(abs(normal), vec3(1));
}

// Least and largest t in the box, a little farther apart; above every t if the frustum does not meet it in front of the eye.
vec2 core_frustum_span(core_node node, core_frustum frustum) {
    const vec3 middle = 0.5 * (node.lower + node.upper), half_size = 0.5 * (node.upper - node.lower);
    const float t = dot(frustum.axis, middle) - frustum.axis_offset, reach = dot(abs(frustum.axis), half_size);
    const float size = dot(abs(frustum.axis), abs(middle) + half_size) + abs(frustum.axis_offset) + abs(t);
    const float slack = 16.0 * CORE_FLOAT_ROUNDOFF * size;
    const bool is_outside = t + reach + slack < frustum.eye_t || core_is_beyond(node, frustum.left, frustum.at_left) ||
                            core_is_beyond(node, frustum.right, frustum.at_right) || core_is_beyond(node, frustum.top, frustum.at_top) ||
                            core_is_beyond(node, frustum.bottom, frustum.at_bottom);
    return is_outside ? vec2(3.3e38) : vec2(t - reach - slack, t + reach + slack);
}

// `column`, `row`: the first pixel.
core_frustum core_tile_frustum(elvis_real column, elvis_real row, uint width, uint height) {
    const core_cut_column left = core_cut_begin(column), right = core_cut_begin(column + elvis_real(width - 1u));
    const elvis_real first = row - left.row0, last = first + elvis_real(height - 1u);
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    const vec3 across = normalize(vec3(core_base_column.xyz)), down = normalize(vec3(core_base_row.xyz));
    core_frustum frustum;
    frustum.at_left = vec3((left.base + first * left.base_row).xyz) + shift;
    frustum.at_right = vec3((right.base + last * right.base_row).xyz) + shift;
    frustum.at_top = frustum.at_left;
    frustum.at_bottom = frustum.at_right;
    const vec3 first_direction = vec3((left.direction + first * left.direction_row).xyz);
    const vec3 last_direction = vec3((right.direction + last * right.direction_row).xyz);
    // Rays of one column differ along `down` only, those of one row along `across`.
    const vec3 axis = cross(across, down);
    const float facing = sign(dot(axis, first_direction));
    frustum.axis = facing * axis;
    frustum.left = facing * cross(down, first_direction);
    frustum.right = -facing * cross(down, last_direction);
    frustum.top = -facing * cross(across, first_direction);
    frustum.bottom = facing * cross(across, last_direction);
    frustum.axis_offset = dot(frustum.axis, vec3(core_base0.xyz) + shift);
    frustum.eye_t = -float(core_reference.w);
    for (int corner = 0; corner < 4; ++corner) {
        const elvis_real down = corner < 2 ? first : last;
        frustum.origins[corner] = vec3(((corner & 1) == 0 ? left.base : right.base).xyz + down * left.base_row.xyz);
        frustum.directions[corner] = vec3(((corner & 1) == 0 ? left.direction : right.direction).xyz + down * left.direction_row.xyz);
    }
    return frustum;
}

#endif
