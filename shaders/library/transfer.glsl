// A transfer function cut at its breakpoints (core/render/transfer_function.hpp): between two of them, or beyond the last, density
// and colour are linear in the field's value less the value that the piece starts from. Values lack the field's offset.
//
// The kernel brings core_n_breakpoints; core_breakpoints, ascending; and core_pieces, one more than those: (from, density, its slope,
// steepness), colour, its slope. Steepness: how much density and light per length change at most with the value, also at the
// piece's ends, but for steps.

struct core_transfer_piece {
    elvis_real from, density, density_slope, steepness;
    elvis_vec3 color, color_slope;
};

core_transfer_piece core_fetch_piece(uint index) {
    const elvis_vec4 first = core_pieces[3u * index];
    return core_transfer_piece(first.x, first.y, first.z, first.w, core_pieces[3u * index + 1u].xyz, core_pieces[3u * index + 2u].xyz);
}

elvis_real core_level_value(uint i) { return core_breakpoints[i]; }

// Of the piece that holds the value.
uint core_piece_index(elvis_real value) {
    uint first = 0u, last = core_n_breakpoints;
    while (first < last) {
        const uint middle = (first + last) / 2u;
        const bool is_below = core_breakpoints[middle] <= value;
        first = is_below ? middle + 1u : first;
        last = is_below ? last : middle;
    }
    return first;
}

elvis_real core_density_at(core_transfer_piece piece, elvis_real value) {
    return max(piece.density + piece.density_slope * (value - piece.from), elvis_real(0));
}

elvis_vec3 core_color_at(core_transfer_piece piece, elvis_real value) { return piece.color + (value - piece.from) * piece.color_slope; }
