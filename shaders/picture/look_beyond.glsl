// Rays that look for surfaces: from the eye on, or behind what was found before. The kernel brings picture/pixel_ray.glsl,
// picture/samples.glsl, core_has_beyond and core_beyond: depths, CORE_FAR where nothing more is wanted.

// Moves the ray's start from the eye to where crossings count, or to behind the last crossing. Returns whether one more is wanted.
bool core_look_beyond(uint pixel, inout core_ray ray) {
    const elvis_real per_length = elvis_real(1) / sqrt(dot(ray.direction, ray.direction)), eye = ray.least_t;
    bool is_wanted = true;
    if (core_has_beyond != 0u) {
        const elvis_real depth = CORE_REAL(core_beyond, pixel);
        is_wanted = depth < CORE_FAR;
        // Rounding of the depth; that of the crossings themselves is a matter of their kind.
        ray.least_t = is_wanted ? depth * per_length + eye + elvis_real(8) * CORE_ROUNDOFF * depth : eye;
        ray.counts_from = ray.least_t;
        ray.widths_behind = elvis_real(2);
    } else {
        // Crossings that rounding moves from one side of this depth to the other are to be found.
        const elvis_real near = core_near.x * per_length;
        ray.least_t = eye + elvis_real(0.5LF) * near;
        ray.counts_from = eye + near;
    }
    return is_wanted;
}
