// Stores the transfer function (core/render/volume/transfer_function.hpp) as pieces between breakpoints of the field's value.
// volume/volume_exact.glsl cuts the ray at them. In a piece density and colour are linear in the field's value less the value that the piece
// starts from. Values lack the field's offset.
//
// The kernel brings core_n_breakpoints; core_breakpoints, ascending; and core_pieces, one more than those: (from, density, its slope,
// steepness), (colour, breakpoint below), (the colour's slope, breakpoint above). Steepness: how much density and light per length change
// at most with the value, also at the piece's ends, but for jumps.

struct core_transfer_piece {
    elvis_real from, density, density_slope, steepness;
    elvis_vec3 color, color_slope;
};

core_transfer_piece core_fetch_piece(uint index) {
    const elvis_vec4 first = CORE_ROW(core_pieces, 3u * index);
    return core_transfer_piece(first.x, first.y, first.z, first.w, CORE_ROW(core_pieces, 3u * index + 1u).xyz,
                               CORE_ROW(core_pieces, 3u * index + 2u).xyz);
}

// Of the piece that holds the value.
uint core_piece_index(elvis_real value) {
    uint first = 0u, last = core_n_breakpoints;
    while (first < last) {
        const uint middle = (first + last) / 2u;
        const bool is_below = CORE_REAL(core_breakpoints, middle) <= value;
        first = is_below ? middle + 1u : first;
        last = is_below ? last : middle;
        if (first >= last) {
            break;
        }
    }
    return first;
}

// The piece used last, and the values that it holds: from `lower` on, below `upper`. Mostly it is the one wanted next. Scalars, since loops
// carry it.
struct core_held_piece {
    uint index;
    elvis_real lower, upper;
    elvis_real from, density, density_slope, steepness;
    elvis_real red, green, blue, red_slope, green_slope, blue_slope;
};

core_held_piece core_load_piece(uint index) {
    const elvis_vec4 first = CORE_ROW(core_pieces, 3u * index);
    const elvis_vec4 color = CORE_ROW(core_pieces, 3u * index + 1u), slope = CORE_ROW(core_pieces, 3u * index + 2u);
    core_held_piece held;
    held.index = index;
    held.lower = color.w;
    held.upper = slope.w;
    held.from = first.x;
    held.density = first.y;
    held.density_slope = first.z;
    held.steepness = first.w;
    held.red = color.x;
    held.green = color.y;
    held.blue = color.z;
    held.red_slope = slope.x;
    held.green_slope = slope.y;
    held.blue_slope = slope.z;
    return held;
}

core_transfer_piece core_piece_of(const core_held_piece held) {
    return core_transfer_piece(held.from, held.density, held.density_slope, held.steepness, elvis_vec3(held.red, held.green, held.blue),
                               elvis_vec3(held.red_slope, held.green_slope, held.blue_slope));
}

elvis_real core_color_slope(const core_held_piece held) {
    return max(max(abs(held.red_slope), abs(held.green_slope)), abs(held.blue_slope));
}

void core_hold_value(inout core_held_piece held, elvis_real value) {
    const bool is_held = value >= held.lower && value < held.upper;
    if (!is_held) {
        held = core_load_piece(core_piece_index(value));
    }
}

elvis_real core_density_at(core_transfer_piece piece, elvis_real value) {
    return max(piece.density + piece.density_slope * (value - piece.from), elvis_real(0));
}

elvis_vec3 core_color_at(core_transfer_piece piece, elvis_real value) { return piece.color + (value - piece.from) * piece.color_slope; }
