// The walk through the subpixels of a pixel: depth first, in the order (0,0) (1,0) (0,1) (1,1), which needs no stack. A subpixel's
// place counts in its own size from the pixel's upper left corner.

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

// The pixel's own square at level 0.
core_picture_square core_searched_place(const core_line_search search) {
    const elvis_real size = elvis_real(1) / elvis_real(1u << search.level), half_one = elvis_real(0.5LF);
    return core_picture_square(search.column - half_one + (elvis_real(search.across) + half_one) * size,
                               search.row - half_one + (elvis_real(search.down) + half_one) * size, half_one * size);
}
