// What a ray's search in a cell is at, and what one evaluation at it tells.
//
// The kernel brings isosurface/ray_interval.glsl and isosurface/nearest_crossing.glsl.

// Offsets from xi, in reference coordinates, below which rounding counts more than what the linearization leaves out.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NARROW elvis_real(6e-8LF)
#else
#define CORE_NARROW elvis_real(2e-3LF)
#endif
// Pieces are not made shorter than this part of that.
#define CORE_FLOOR elvis_real(0.25LF)

struct core_search {
    // CORE_NO_ELEMENT: nothing is looked at.
    uint element;
    // The piece; where the one after it begins, and where the cell ends.
    elvis_real from, to, next, last;
    // Half of what is looked at at least: where the field is so flat that rounding moves the crossing by more than the piece is long.
    elvis_real wide;
    // Where the mapping is linearized.
    elvis_real x, y, z;
    // Of the mapping in the cell.
    elvis_real curvature;
    // Bound of the field's second derivatives, from the last piece that was long enough for it.
    elvis_real bend;
    // Evaluations in the cell; those of them that linearized the mapping anew for the same piece.
    uint used, moves;
};

core_search core_search_nothing() {
    core_search search;
    search.element = CORE_NO_ELEMENT;
    search.from = search.to = search.next = search.last = search.wide = elvis_real(0);
    search.x = search.y = search.z = elvis_real(0);
    search.curvature = elvis_real(0);
    search.bend = CORE_FAR;
    search.used = search.moves = 0u;
    return search;
}

struct core_look {
    // The search's element, or any where it has none.
    uint element;
    elvis_vec3 xi;
    core_frame frame;
    // Of the piece: where the ray's parameter s is zero, half its length, and half of what was looked at.
    elvis_real middle, half_width, reach;
    // The shortest half length of a piece.
    elvis_real shortest;
    // Change of reference coordinates along the ray, in the maximum norm.
    elvis_real speed;
    core_piece piece;
    // Of the field's model: its slope in reference coordinates.
    elvis_vec3 slope;
    core_crossing crossing;
    // Bound of the field's second derivatives along curves that are straight in the world: the mapping's own bending counts, too.
    elvis_real bend;
    bool is_finite;
#if ELVIS_HAS_INSIDE
    core_inside own;
#endif
};

// From here on the remainder of a model tells second derivatives, not rounding.
#define CORE_WIDE_ENOUGH (elvis_real(8) * CORE_NARROW)

core_look core_look_at(core_ray ray, inout core_search search) {
    core_look look;
    look.element = search.element != CORE_NO_ELEMENT ? search.element : 0u;
    look.xi = elvis_vec3(search.x, search.y, search.z);
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(look.element, look.xi, position, jacobian);
    const elvis_vec3 shift = core_reference.xyz - elvis_origin(look.element);
    look.middle = elvis_real(0.5LF) * (search.from + search.to);
    const elvis_vec3 step = look.middle * ray.direction;
    const elvis_real error = ray.error + elvis_real(2) * CORE_ROUNDOFF * (core_max_norm(shift) + core_max_norm(step));
    look.frame = core_frame_at(position, jacobian, error);
    look.speed = core_max_norm(core_to_xi(look.frame, ray.direction));
    look.shortest = CORE_FLOOR * CORE_NARROW / look.speed;
    look.half_width = elvis_real(0.5LF) * (search.to - search.from);
    look.reach = max(max(look.half_width, look.shortest), search.wide);
    look.piece = core_piece_in_element(look.xi, look.frame, ((shift - position) + ray.origin) + step, ray.direction, look.reach,
                                       search.curvature);
#if ELVIS_HAS_INSIDE
    look.own = core_inside_at(look.element, look.xi);
    core_cut_piece_inside(look.own, look.piece);
#endif
    core_model model;
    elvis_real value;
    core_piece_take_field(look.piece, look.element, look.xi, model, value);
    look.slope = model.slope;
    look.crossing = core_first_crossing(look.piece);
    const bool is_wide_enough = look.piece.radius > CORE_WIDE_ENOUGH;
    search.bend = is_wide_enough ? elvis_real(2) * model.remainder / (look.piece.radius * look.piece.radius) : search.bend;
    look.bend = search.bend + elvis_real(2) * search.curvature * core_model_norm1(model.slope);
    look.is_finite = core_is_finite(value + core_max_norm(position));
    return look;
}
