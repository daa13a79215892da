// A ray's search for a crossing in one octant: which interval is looked at next.
//
// The kernel brings isosurface/interval_bounds.glsl, isosurface/interval_root.glsl and isosurface/octant.glsl.

// Evaluations in one octant, beyond which the ray is left to projection.
#define CORE_MOST_EVALUATIONS 96u
// Times the mapping is linearized anew nearer to the interval before it is halved.
#define CORE_MOST_MOVES 8u
// The field is bounded at most this far to both sides of an interval's middle, in reference coordinates.
#define CORE_WIDEST elvis_real(0.25LF)

// How far to both sides a field is bounded that is flat around the candidate.
elvis_real core_wider(core_linear_root candidate) { return elvis_real(4) * candidate.half_width; }

// Starts with the ray's span in an octant. Returns flags of the pixel.
uint core_interval_search_begin(const core_octant octant, core_octant_span reached, out core_interval_search search) {
    search.x = elvis_real(reached.xi.x);
    search.y = elvis_real(reached.xi.y);
    search.z = elvis_real(reached.xi.z);
    core_project(search.x, search.y, search.z);
    search.from = elvis_real(reached.span.x);
    search.to = search.next = search.last = elvis_real(reached.span.y);
    search.element = reached.is_met ? octant.element : CORE_NO_ELEMENT;
    search.curvature = elvis_real(octant.curvature);
    search.bent_code = core_is_bent(octant) || CORE_HAS_BEND_FORMS == 1 ? octant.code & ~CORE_OCTANT_ESTIMATED : CORE_NO_CODE;
    search.used = search.moves = 0u;
    search.wide = elvis_real(0);
    search.shortest = CORE_FLOOR * CORE_NARROW;
    const elvis_real half_side = elvis_real(core_octant_half_side(octant.code));
    // Around a bent octant the ray may be in others, too.
    const bool is_bend_known = CORE_ERRORS_TELL_BENDS && !core_is_bent(octant);
    search.bend = is_bend_known ? elvis_real(2) * elvis_real(octant.error) / (half_side * half_side) : CORE_FAR;
    const bool is_dismissed = reached.is_inside && !reached.is_met;
    return is_dismissed && (octant.code & CORE_OCTANT_ESTIMATED) != 0u ? CORE_FLAG_ESTIMATED : 0u;
}

// What is made of an interval.
struct core_verdict {
    // Nothing of it lies in the element; or no isovalue is taken in it. These and the next three are false for a search without an
    // interval.
    bool is_empty, is_excluded;
    // Its candidate is proven and exact, wherever that lies.
    bool is_finished_root;
    // It cannot be decided; nor can anything behind it.
    bool is_stuck, is_broken;
    // What is next: the interval behind it; what is left from cut_low to cut_high; the same one, with the mapping linearized nearer to it
    // or the field bounded farther around it. Otherwise its first half. Shorter intervals than before may follow.
    bool goes_on, cuts, moves_on, widens, narrows;
    elvis_real cut_low, cut_high;
};

core_verdict core_judge_interval(const core_evaluation evaluation, const core_root root, const core_interval_search search) {
    const core_ray_interval interval = evaluation.interval;
    const core_linear_root candidate = evaluation.candidate;
    const bool is_active = search.element != CORE_NO_ELEMENT;
    core_verdict verdict;
    // From the point of the element that is nearest to the interval's middle, as predicted.
    elvis_real near_x = evaluation.xi.x + clamp(interval.q.x, elvis_real(-4), elvis_real(4));
    elvis_real near_y = evaluation.xi.y + clamp(interval.q.y, elvis_real(-4), elvis_real(4));
    elvis_real near_z = evaluation.xi.z + clamp(interval.q.z, elvis_real(-4), elvis_real(4));
    core_project(near_x, near_y, near_z);
    const elvis_real move = max(max(abs(near_x - evaluation.xi.x), abs(near_y - evaluation.xi.y)), abs(near_z - evaluation.xi.z));
    const elvis_real extent = max(evaluation.half_width, evaluation.shortest) * evaluation.speed;
    const bool is_far = move > elvis_real(0.25LF) * extent && move > elvis_real(16) * CORE_ROUNDOFF;
    // The bound says nothing far away from a curved element: as is_clear in lines/subpixel.glsl.
    const bool is_clear =
        !is_far && search.curvature < elvis_real(1e6LF) && interval.clearance > elvis_real(0.5LF) * extent + elvis_real(8) * move;
    const bool is_empty = interval.low > interval.high || is_clear;
    const bool is_done_with = is_empty || candidate.is_excluded;
    const bool ends_here = is_active && !is_done_with && root.is_proven;
    verdict.is_empty = is_active && is_empty;
    verdict.is_excluded = is_active && !is_empty && candidate.is_excluded;
    verdict.is_finished_root = ends_here && root.is_exact;
    verdict.is_broken = is_active && (!evaluation.is_finite || search.used >= CORE_MOST_EVALUATIONS);

    // If little is left it is looked at as a whole, even if it reaches beyond the interval: then the root is in its middle.
    const elvis_real from = candidate.s - candidate.half_width, to = candidate.s + candidate.half_width;
    const elvis_real narrow = elvis_real(0.6LF) * (interval.high - interval.low);
    const bool is_narrow = interval.is_known && to - from < narrow && from <= interval.high && to >= interval.low;
    verdict.cut_low = root.is_proven || is_narrow ? from : max(from, interval.low);
    verdict.cut_high = root.is_proven || is_narrow ? to : min(to, interval.high);
    const bool is_cut = is_narrow || (interval.is_known && verdict.cut_high - verdict.cut_low < narrow);

    // Of fields of high order the line may leave out more than rounding does, however short the interval is.
    verdict.narrows = evaluation.half_width < evaluation.shortest && !is_done_with && !root.is_proven && !root.is_mostly_rounding &&
                      search.wide == elvis_real(0) &&
                      search.shortest > CORE_FLOOR_ROUNDINGS * core_max_norm(evaluation.frame.xi_error);
    const bool is_short = evaluation.half_width < evaluation.shortest && !verdict.narrows;
    const elvis_real wider = core_wider(candidate);
    verdict.widens = is_short && !is_done_with && !root.is_proven && !is_cut && wider > elvis_real(1.5LF) * search.wide &&
                     wider * evaluation.speed < CORE_WIDEST;
    const bool is_nearest =
        interval.radius <= max(search.shortest / CORE_FLOOR, elvis_real(2) * search.wide * evaluation.speed) ||
        search.moves >= CORE_MOST_MOVES;
    verdict.is_stuck = is_active && is_short && !is_done_with && !verdict.widens && !(is_cut && search.moves < CORE_MOST_MOVES) &&
                       is_nearest && !ends_here;
    verdict.goes_on = is_done_with || verdict.is_finished_root || verdict.is_stuck || verdict.is_broken;
    verdict.cuts = !verdict.goes_on && (ends_here || is_cut);
    verdict.moves_on =
        !verdict.goes_on && !verdict.cuts && (verdict.widens || is_short || (is_far && search.moves < CORE_MOST_MOVES));
    return verdict;
}

// To the next interval, or to none. `ends`: a crossing was found, before which there is none; behind `nearest_end` nothing need be
// looked at. Returns whether something stays undecided.
bool core_interval_search_next(const core_evaluation evaluation, const core_verdict verdict, bool ends, elvis_real nearest_end,
                               inout core_interval_search search) {
    const core_ray_interval interval = evaluation.interval;
    const bool is_done_with = verdict.is_empty || verdict.is_excluded;
    // The next interval is as long as this one, or twice if that was easy; the last one takes what would be left.
    const elvis_real length_next = (is_done_with ? elvis_real(4) : elvis_real(2)) * max(evaluation.half_width, evaluation.shortest);
    const elvis_real after = search.next + length_next;
    // Behind a root that does not count there may be another isovalue's.
    const bool has_another = verdict.is_finished_root && !evaluation.candidate.is_only;
    const elvis_real behind_root = evaluation.middle + verdict.cut_high;
    const elvis_real from = has_another        ? min(search.next, behind_root)
                            : verdict.goes_on  ? search.next
                            : verdict.cuts     ? evaluation.middle + verdict.cut_low
                            : verdict.moves_on ? search.from
                                               : evaluation.middle + interval.low;
    const elvis_real to = verdict.goes_on    ? (after + elvis_real(0.5LF) * length_next >= search.last ? search.last : after)
                          : verdict.cuts     ? evaluation.middle + verdict.cut_high
                          : verdict.moves_on ? search.to
                                             : evaluation.middle + elvis_real(0.5LF) * (interval.low + interval.high);
    // Behind the only isovalue of the interval, the interval is over.
    const elvis_real after_cut = evaluation.candidate.is_only ? search.next : min(search.next, evaluation.middle + verdict.cut_high);
    search.next = verdict.goes_on ? to : verdict.cuts ? after_cut : verdict.moves_on ? search.next : to;
    const bool is_short = evaluation.half_width < evaluation.shortest && !verdict.narrows;
    search.moves = (verdict.moves_on && !verdict.widens) || (verdict.cuts && is_short) ? search.moves + 1u : 0u;
    search.shortest *= verdict.narrows ? elvis_real(0.25LF) : elvis_real(1);
    search.wide = verdict.widens ? core_wider(evaluation.candidate) : verdict.goes_on ? elvis_real(0) : search.wide;
    const bool has_more = from < search.last && from < to && from <= nearest_end;
    const bool is_open = verdict.is_stuck || (verdict.is_broken && (!is_done_with || has_more));
    search.element = ends || verdict.is_broken || (verdict.goes_on && !has_more) ? CORE_NO_ELEMENT : search.element;
    search.from = from;
    search.to = max(to, from);
    // The point of the element that is nearest to its middle. Whole steps may go to and fro in a strongly curved element.
    const elvis_real to_middle = elvis_real(0.5LF) * (search.from + search.to) - evaluation.middle;
    const elvis_vec3 forward = interval.q + to_middle * interval.w;
    const bool is_usable = core_is_finite(forward.x + forward.y + forward.z);
    elvis_real x = evaluation.xi.x + (is_usable ? clamp(forward.x, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    elvis_real y = evaluation.xi.y + (is_usable ? clamp(forward.y, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    elvis_real z = evaluation.xi.z + (is_usable ? clamp(forward.z, elvis_real(-4), elvis_real(4)) : elvis_real(0));
    core_project(x, y, z);
    const elvis_real share = search.moves > CORE_MOST_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
    search.x += share * (x - search.x);
    search.y += share * (y - search.y);
    search.z += share * (z - search.z);
    return is_open;
}
