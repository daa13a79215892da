// The walk through the subpixels of a pixel: depth first, in the order (0,0) (1,0) (0,1) (1,1), which needs no stack. A subpixel is a
// square of the picture; its place counts in its own size from the pixel's upper left corner.

// To the subpixel after this one and all that end with it; false after the last.
bool core_next_subpixel(inout uint level, inout uint across, inout uint down) {
    while (level > 0u && (across & 1u) != 0u && (down & 1u) != 0u) {
        level -= 1u;
        across >>= 1;
        down >>= 1;
    }
    const bool is_last = level == 0u;
    down += !is_last && (across & 1u) != 0u ? 1u : 0u;
    across = is_last ? 0u : across ^ 1u;
    return !is_last;
}

elvis_real core_subpixel_size(uint level) { return elvis_real(1) / elvis_real(1u << level); }

// Middle of a subpixel along one direction of the picture; `pixel`: of the pixel's.
elvis_real core_subpixel_middle(elvis_real pixel, uint place, elvis_real size) {
    return pixel - elvis_real(0.5LF) + (elvis_real(place) + elvis_real(0.5LF)) * size;
}
