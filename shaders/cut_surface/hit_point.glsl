// The point at which a pixel's ray meets the surface. The kernel brings picture/view.glsl.

#include "surface/hit_record.glsl"

// `most_error`: the most that a point's error along the ray may be; where it is more the pixel is undecided anyway.
core_cut_point core_hit_point(core_cut_column along, elvis_real row, core_hit_record hit, float most_error) {
    const elvis_real down = row - along.row0;
    const elvis_vec4 base = along.base + down * along.base_row;
    const elvis_vec4 direction = along.direction + down * along.direction_row;
    core_cut_point point;
    point.t = hit.t;
    point.is_hit = true;
    point.is_near = point.is_doubtful = false;
    point.direction = direction.xyz;
    point.position = base.xyz + point.t * direction.xyz;
    const elvis_vec3 size = (along.size + abs(down * along.base_row)).xyz + abs(point.t * direction.xyz);
    point.error = elvis_real(4) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z) +
                  min(hit.error * length(direction.xyz), elvis_real(most_error));
    return point;
}
