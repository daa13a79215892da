// The rays of segments/find_walk.comp and segments/segments.comp: those of pixels, or (CORE_RAYS_ARE_GIVEN) of a list.
//
// The kernel brings core_extent, the diagonal of the volume's bounds, and for rays that are given their binding, CORE_RAYS_BINDING.

#include "arithmetic/precision.glsl"
#include "arithmetic/read_only.glsl"
#include "tiles/hierarchy.glsl"

#if CORE_RAYS_ARE_GIVEN
#include "tiles/box_ray.glsl"
layout(set = 0, binding = 0, std140) uniform core_frame_block {
    // Of the hierarchies' origin in the world.
    elvis_vec4 core_centre;
};
// Relative to the hierarchies' origin; (origin, from), (direction, to) for each ray.
layout(set = 0, binding = CORE_RAYS_BINDING) CORE_READ_ROWS(core_rays);
#define CORE_CENTRE core_centre.xyz
#else
#include "picture/view.glsl"
#include "picture/pixel_ray.glsl"
#define CORE_CENTRE core_reference.xyz
#endif

// `index`: row * core_size.x + column.
core_ray core_source_ray(uint column, uint row, uint index) {
#if CORE_RAYS_ARE_GIVEN
    const elvis_vec4 first = CORE_ROW(core_rays, 2u * index);
    core_ray ray;
    ray.origin = first.xyz;
    ray.direction = CORE_ROW(core_rays, 2u * index + 1u).xyz;
    ray.least_t = ray.counts_from = first.w;
    ray.widths_behind = elvis_real(0);
    ray.box_origin = vec3(ray.origin);
    const vec3 far = abs(ray.box_origin);
    ray.far = max(max(far.x, far.y), max(far.z, core_extent));
    // Of origin + t * direction where the volume is.
    ray.error = elvis_real(4) * CORE_ROUNDOFF * elvis_real(ray.far);
    return ray;
#else
    return core_pixel_ray(core_cut_begin(elvis_real(column)), elvis_real(row));
#endif
}

// Where the ray ends.
elvis_real core_source_ray_end(uint index) {
#if CORE_RAYS_ARE_GIVEN
    return CORE_ROW(core_rays, 2u * index + 1u).w;
#else
    return CORE_FAR;
#endif
}
