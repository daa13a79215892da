// The ray of a pixel, or one that is given, as segments/segment.glsl wants it. The kernel brings core_ray.

#ifndef CORE_TRACED_RAY
#define CORE_TRACED_RAY

// Distance within which the ends of segments are wanted, over the volume's size.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_END_TOLERANCE elvis_real(2e-14LF)
#else
#define CORE_END_TOLERANCE elvis_real(2.5e-7LF)
#endif
// Share of the bound of rounding that is met at worst: segments that are shorter than what it makes of them are not found.
#define CORE_ROUNDING_SHARE elvis_real(0.125LF)

struct core_traced_ray {
    // Relative to the hierarchies' origin; any length.
    elvis_vec3 origin, direction;
    // Bound of the rounding of its points' coordinates.
    elvis_real error;
    // Parameters closer than this are the same: the distance that ends may be off, over the direction's length.
    elvis_real tolerance, speed;
    // Longest way through the volume, as a parameter.
    elvis_real longest;
};

// `extent`: the diagonal of the volume's bounds. `data_error`: neighbours' edges and faces agree no better, and a ray must not slip through.
core_traced_ray core_traced_ray_of(core_ray pixel_ray, elvis_real extent, elvis_real data_error) {
    core_traced_ray ray;
    ray.origin = pixel_ray.origin;
    ray.direction = pixel_ray.direction;
    ray.speed = length(pixel_ray.direction);
    ray.error = CORE_ROUNDING_SHARE * (pixel_ray.error + elvis_real(2) * CORE_ROUNDOFF * extent) + data_error;
    ray.tolerance = CORE_END_TOLERANCE * extent / ray.speed;
    ray.longest = elvis_real(4) * extent / ray.speed;
    return ray;
}

#endif
