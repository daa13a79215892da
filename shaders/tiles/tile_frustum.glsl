// The rays of a rectangle of pixels, all together. The kernel brings picture/cut_frame.glsl and tiles/hierarchy.glsl.

#ifndef CORE_TILE_BEAM
#define CORE_TILE_BEAM

// They lie between four planes; each is given by a point, its normal inwards, and the sizes of both for rounding.
struct core_beam {
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

// Least and largest t in the box, a little farther apart; above every t if the beam does not meet it in front of the eye.
vec2 core_beam_span(core_node node, core_beam beam) {
    const vec3 middle = 0.5 * (node.lower + node.upper), half_size = 0.5 * (node.upper - node.lower);
    const float t = dot(beam.axis, middle) - beam.axis_offset, reach = dot(abs(beam.axis), half_size);
    const float size = dot(abs(beam.axis), abs(middle) + half_size) + abs(beam.axis_offset) + abs(t);
    const float slack = 16.0 * CORE_FLOAT_ROUNDOFF * size;
    const bool is_outside = t + reach + slack < beam.eye_t || core_is_beyond(node, beam.left, beam.at_left) ||
                            core_is_beyond(node, beam.right, beam.at_right) || core_is_beyond(node, beam.top, beam.at_top) ||
                            core_is_beyond(node, beam.bottom, beam.at_bottom);
    return is_outside ? vec2(3.3e38) : vec2(t - reach - slack, t + reach + slack);
}

// `column`, `row`: the first pixel.
core_beam core_tile_beam(elvis_real column, elvis_real row, uint width, uint height) {
    const core_cut_column left = core_cut_begin(column), right = core_cut_begin(column + elvis_real(width - 1u));
    const elvis_real first = row - left.row0, last = first + elvis_real(height - 1u);
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    const vec3 across = normalize(vec3(core_base_column.xyz)), down = normalize(vec3(core_base_row.xyz));
    core_beam beam;
    beam.at_left = vec3((left.base + first * left.base_row).xyz) + shift;
    beam.at_right = vec3((right.base + last * right.base_row).xyz) + shift;
    beam.at_top = beam.at_left;
    beam.at_bottom = beam.at_right;
    const vec3 first_direction = vec3((left.direction + first * left.direction_row).xyz);
    const vec3 last_direction = vec3((right.direction + last * right.direction_row).xyz);
    // Rays of one column differ along `down` only, those of one row along `across`.
    const vec3 axis = cross(across, down);
    const float facing = sign(dot(axis, first_direction));
    beam.axis = facing * axis;
    beam.left = facing * cross(down, first_direction);
    beam.right = -facing * cross(down, last_direction);
    beam.top = -facing * cross(across, first_direction);
    beam.bottom = facing * cross(across, last_direction);
    beam.axis_offset = dot(beam.axis, vec3(core_base0.xyz) + shift);
    beam.eye_t = -float(core_reference.w);
    for (int corner = 0; corner < 4; ++corner) {
        const elvis_real down = corner < 2 ? first : last;
        beam.origins[corner] = vec3(((corner & 1) == 0 ? left.base : right.base).xyz + down * left.base_row.xyz);
        beam.directions[corner] = vec3(((corner & 1) == 0 ? left.direction : right.direction).xyz + down * left.direction_row.xyz);
    }
    return beam;
}

#endif
