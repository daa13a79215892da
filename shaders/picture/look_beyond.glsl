// Rays that go on behind what was found before. The kernel brings picture/pixel_ray.glsl, picture/samples.glsl, core_has_beyond and
// core_beyond: depths, CORE_FAR where nothing more is wanted.

// Moves the ray's start to behind the last crossing. Returns whether one more is wanted.
bool core_look_beyond(uint pixel, inout core_ray ray) {
    bool is_wanted = true;
    if (core_has_beyond != 0u) {
        const elvis_real depth = core_beyond[pixel];
        const elvis_real per_length = elvis_real(1) / sqrt(dot(ray.direction, ray.direction));
        const elvis_real t = depth * per_length + ray.least_t;
        is_wanted = depth < CORE_FAR;
        // Rounding of the depth; that of the crossings themselves is a matter of their kind.
        ray.least_t = is_wanted ? t + elvis_real(8) * CORE_ROUNDOFF * depth : ray.least_t;
        ray.widths_behind = elvis_real(2);
    }
    return is_wanted;
}
