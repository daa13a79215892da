// A ray's search for a crossing in one cell: which piece is looked at next.
//
// The kernel brings isosurface/interval_bounds.glsl, isosurface/interval_root.glsl and isosurface/octant.glsl.

// Evaluations in one cell, beyond which the ray is left to projection.
#define CORE_MOST_EVALUATIONS 96u
// Times the mapping is linearized anew nearer to the piece before it is halved.
#define CORE_MAX_MOVES 8u
// Half of what is looked at at most, in reference coordinates.
#define CORE_WIDEST elvis_real(0.25LF)

// Half of what is looked at of a field that is flat around the crossing.
elvis_real core_wider(core_crossing crossing) { return elvis_real(4) * crossing.half_width; }

// Starts with the part of a ray in a cell. Returns flags of the pixel.
uint core_search_begin(core_level_cell cell, core_cell_part part, out core_search search) {
    search.x = elvis_real(part.xi.x);
    search.y = elvis_real(part.xi.y);
    search.z = elvis_real(part.xi.z);
    core_project(search.x, search.y, search.z);
    search.from = elvis_real(part.span.x);
    search.to = search.next = search.last = elvis_real(part.span.y);
    search.element = part.is_met ? cell.element : CORE_NO_ELEMENT;
    search.curvature = elvis_real(cell.curvature);
    search.used = search.moves = 0u;
    search.wide = elvis_real(0);
    const elvis_real half_side = elvis_real(core_cell_half_side(cell.code));
    search.bend = elvis_real(2) * elvis_real(cell.error) / (half_side * half_side);
    const bool is_dismissed = part.is_inside && !part.is_met;
    return is_dismissed && (cell.code & CORE_CELL_ESTIMATED) != 0u ? CORE_FLAG_ESTIMATED : 0u;
}

// What is made of a piece.
struct core_verdict {
    // Nothing of it lies in the element; or no isovalue is taken in it. These and the next three are false for a search without a piece.
    bool is_empty, is_excluded;
    // Its root is a crossing, wherever that lies.
    bool is_crossing;
    // It cannot be decided; nor can anything behind it.
    bool is_stuck, is_broken;
    // What is next: the piece behind it; the part of it from part_low to part_high; the same one, looked at from nearer or wider. Otherwise
    // its first half.
    bool goes_on, cuts, moves_on, widens;
    elvis_real part_low, part_high;
};

core_verdict core_judge_piece(core_look look, core_root root, core_search search) {
    const core_piece piece = look.piece;
    const core_crossing crossing = look.crossing;
    const bool is_active = search.element != CORE_NO_ELEMENT;
    core_verdict verdict;
    // From the point of the element that is nearest to the piece's middle, as predicted.
    elvis_real near_x = look.xi.x + clamp(piece.q.x, elvis_real(-4), elvis_real(4));
    elvis_real near_y = look.xi.y + clamp(piece.q.y, elvis_real(-4), elvis_real(4));
    elvis_real near_z = look.xi.z + clamp(piece.q.z, elvis_real(-4), elvis_real(4));
    core_project(near_x, near_y, near_z);
    const elvis_real move = max(max(abs(near_x - look.xi.x), abs(near_y - look.xi.y)), abs(near_z - look.xi.z));
    const elvis_real extent = max(look.half_width, look.shortest) * look.speed;
    const bool is_far = move > elvis_real(0.25LF) * extent && move > elvis_real(16) * CORE_ROUNDOFF;
    // The bound says nothing far away from a curved element: see core_is_clear_of.
    const bool is_clear =
        !is_far && search.curvature < elvis_real(1e6LF) && piece.clearance > elvis_real(0.5LF) * extent + elvis_real(8) * move;
    const bool is_empty = piece.low > piece.high || is_clear;
    const bool is_done_with = is_empty || crossing.is_excluded;
    const bool ends_here = is_active && !is_done_with && root.is_crossing;
    verdict.is_empty = is_active && is_empty;
    verdict.is_excluded = is_active && !is_empty && crossing.is_excluded;
    verdict.is_crossing = ends_here && root.is_exact;
    verdict.is_broken = is_active && (!look.is_finite || search.used >= CORE_MOST_EVALUATIONS);

    // A narrow part is looked at as a whole, even if it reaches beyond the piece: then the root is in its middle.
    const elvis_real from = crossing.s - crossing.half_width, to = crossing.s + crossing.half_width;
    const elvis_real narrow = elvis_real(0.6LF) * (piece.high - piece.low);
    const bool is_part = piece.is_known && to - from < narrow && from <= piece.high && to >= piece.low;
    verdict.part_low = root.is_crossing || is_part ? from : max(from, piece.low);
    verdict.part_high = root.is_crossing || is_part ? to : min(to, piece.high);
    const bool is_cut = is_part || (piece.is_known && verdict.part_high - verdict.part_low < narrow);

    const bool is_short = look.half_width < look.shortest;
    const elvis_real wider = core_wider(crossing);
    verdict.widens = is_short && !is_done_with && !root.is_crossing && !is_cut && wider > elvis_real(1.5LF) * search.wide &&
                     wider * look.speed < CORE_WIDEST;
    const bool is_nearest = piece.radius <= max(CORE_NARROW, elvis_real(2) * search.wide * look.speed) || search.moves >= CORE_MAX_MOVES;
    verdict.is_stuck = is_active && is_short && !is_done_with && !verdict.widens && !(is_cut && search.moves < CORE_MAX_MOVES) &&
                       is_nearest && !ends_here;
    verdict.goes_on = is_done_with || verdict.is_crossing || verdict.is_stuck || verdict.is_broken;
    verdict.cuts = !verdict.goes_on && (ends_here || is_cut);
    verdict.moves_on =
        !verdict.goes_on && !verdict.cuts && (verdict.widens || is_short || (is_far && search.moves < CORE_MAX_MOVES));
    return verdict;
}

// To the next piece, or to none. `ends`: a crossing was found, before which there is none; `nearest_end`: nothing need be looked at
// behind. Returns whether what is left cannot be decided.
bool core_search_on(core_look look, core_verdict verdict, bool ends, elvis_real nearest_end, inout core_search search) {
    const core_piece piece = look.piece;
    const bool is_done_with = verdict.is_empty || verdict.is_excluded;
    // The next piece is as long as this one, or twice if that was easy; the last one takes what would be left.
    const elvis_real length_next = (is_done_with ? elvis_real(4) : elvis_real(2)) * max(look.half_width, look.shortest);
    const elvis_real after = search.next + length_next;
    const elvis_real from = verdict.goes_on    ? search.next
                            : verdict.cuts     ? look.middle + verdict.part_low
                            : verdict.moves_on ? search.from
                                               : look.middle + piece.low;
    const elvis_real to = verdict.goes_on    ? (after + elvis_real(0.5LF) * length_next >= search.last ? search.last : after)
                          : verdict.cuts     ? look.middle + verdict.part_high
                          : verdict.moves_on ? search.to
                                             : look.middle + elvis_real(0.5LF) * (piece.low + piece.high);
    // After a part that holds the only isovalue of the piece, the piece is over.
    const elvis_real after_part = look.crossing.is_only ? search.next : min(search.next, look.middle + verdict.part_high);
    search.next = verdict.goes_on ? to : verdict.cuts ? after_part : verdict.moves_on ? search.next : to;
    const bool is_short = look.half_width < look.shortest;
    search.moves = (verdict.moves_on && !verdict.widens) || (verdict.cuts && is_short) ? search.moves + 1u : 0u;
    search.wide = verdict.widens ? core_wider(look.crossing) : verdict.goes_on ? elvis_real(0) : search.wide;
    const bool has_more = from < search.last && from < to && from <= nearest_end;
    const bool is_open = verdict.is_stuck || (verdict.is_broken && (!is_done_with || has_more));
    search.element = ends || verdict.is_broken || (verdict.goes_on && !has_more) ? CORE_NO_ELEMENT : search.element;
    search.from = from;
    search.to = max(to, from);
    // The point of the element that is nearest to its middle. Whole steps may go to and fro in a strongly curved element.
    const elvis_real to_middle = elvis_real(0.5LF) * (search.from + search.to) - look.middle;
    const elvis_vec3 forward = piece.q + to_middle * piece.w;
    const bool is_usable = core_is_finite(forward.x + forward.y + forward.z);
    elvis_real x = look.xi.x + (is_usable ? clamp(forward.x, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    elvis_real y = look.xi.y + (is_usable ? clamp(forward.y, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    elvis_real z = look.xi.z + (is_usable ? clamp(forward.z, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    core_project(x, y, z);
    const elvis_real share = search.moves > CORE_MAX_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
    search.x += share * (x - search.x);
    search.y += share * (y - search.y);
    search.z += share * (z - search.z);
    return is_open;
}
