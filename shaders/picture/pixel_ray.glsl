// Rays of pixels.
//
// The kernel brings picture/view.glsl and tiles/hierarchy.glsl.

#include "tiles/box_ray.glsl"

core_ray core_pixel_ray(core_cut_column along, elvis_real row) {
    const elvis_real down = row - along.row0;
    core_ray ray;
    ray.origin = (along.base + down * along.base_row).xyz;
    ray.direction = (along.direction + down * along.direction_row).xyz;
    ray.least_t = ray.counts_from = -along.reference_distance;
    ray.widths_behind = elvis_real(0);
    const elvis_vec3 size = (along.size + abs(down * along.base_row)).xyz;
    ray.error = elvis_real(4) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    ray.box_origin = vec3(ray.origin + core_reference_in_hierarchy.xyz);
    const vec3 far = vec3(size) + abs(vec3(core_reference_in_hierarchy.xyz));
    ray.far = max(max(far.x, far.y), far.z);
    return ray;
}
