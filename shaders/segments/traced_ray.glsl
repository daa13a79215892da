// A pixel's ray as segments/segment.glsl wants it. The kernel brings both and picture/pixel_ray.glsl.

// Distance within which the ends of segments are wanted, over the volume's size.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_END_TOLERANCE elvis_real(2e-14LF)
#else
#define CORE_END_TOLERANCE elvis_real(2.5e-7LF)
#endif
// Share of the bound of rounding that is met at worst: segments that are shorter than what it makes of them are not found.
#define CORE_ROUNDING_SHARE elvis_real(0.125LF)

// `extent`: the diagonal of the volume's bounds.
core_traced_ray core_traced_ray_of(core_ray pixel_ray, elvis_real extent) {
    core_traced_ray ray;
    ray.origin = pixel_ray.origin;
    ray.direction = pixel_ray.direction;
    ray.speed = length(pixel_ray.direction);
    ray.error = CORE_ROUNDING_SHARE * (pixel_ray.error + elvis_real(2) * CORE_ROUNDOFF * extent);
    ray.tolerance = CORE_END_TOLERANCE * extent / ray.speed;
    ray.longest = elvis_real(4) * extent / ray.speed;
    return ray;
}
