// The part of a ray that the clipping planes of an isosurface leave, and a little more (core/render/isosurface/isosurface_pass.cpp): what is
// cut away is not searched, and leaves nothing open. Which points are cut away is decided where colours are made (picture/color.comp).
//
// The kernel brings isosurface/isosurface_bindings.glsl, core_n_isovalues and core_n_clips.

struct core_kept_part {
    elvis_real from, to;
};

core_kept_part core_kept_part_of(const core_ray ray) {
    elvis_real from = ray.least_t, to = CORE_FAR;
    for (uint i = 0u; i < core_n_clips; ++i) {
        const uint row = core_n_isovalues + 4u * i;
        const elvis_vec3 normal = CORE_REAL3(core_isovalues, row);
        const elvis_real above = dot(normal, ray.origin) + CORE_REAL(core_isovalues, row + 3u), slope = dot(normal, ray.direction);
        const elvis_real crossing = -above / slope;
        from = slope > elvis_real(0) ? max(from, crossing) : from;
        to = slope < elvis_real(0) ? min(to, crossing) : to;
        to = slope == elvis_real(0) && above < elvis_real(0) ? -CORE_FAR : to;
    }
    return core_kept_part(from, to);
}

// Begins the ray where the part does, and ends the search where it ends. Returns whether there is any.
bool core_keep_part(inout core_ray ray, inout core_nearest_crossing nearest) {
    const core_kept_part part = core_kept_part_of(ray);
    const bool ends = part.to < nearest.t;
    ray.least_t = part.from;
    nearest.t = ends ? part.to : nearest.t;
    nearest.slack = ends ? elvis_real(0) : nearest.slack;
    return part.from <= part.to;
}
