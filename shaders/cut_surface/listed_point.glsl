// An open point of the list (cut_surface/open_points.glsl) and the picture there, for kernels that look into octants.
//
// Unless CORE_ON_PLANE, the kernel brings core_hits.

core_cut_point core_point_of(uint pixel) {
    const core_cut_column along = core_cut_begin(elvis_real(pixel % core_size.x));
    const elvis_real row = elvis_real(pixel / core_size.x);
#if CORE_ON_PLANE
    core_cut_point point = core_cut_pixel(along, row);
#else
    core_cut_point point = core_hit_point(along, row, core_hits[pixel], core_most_error);
#endif
    point.error += core_data_error();
    return point;
}

// Whether the pixel's point would be seen, and no other class has found it.
bool core_is_wanted(uint pixel, core_cut_point point) {
    const uint surface = core_marks[pixel].owner >> CORE_OWNER_BITS;
    const elvis_real depth = (point.t + core_reference.w) * length(point.direction);
    return surface == 0u || (surface != core_surface_number && depth < core_samples[pixel].depth);
}
