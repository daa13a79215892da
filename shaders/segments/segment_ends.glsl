// How the interval in which an end of a segment is looked for shrinks, by what an iteration tells of it (segments/segment.glsl).

// Before the ray enters: where the interval is open, and whether the ray enters in it.
// `is_blurred`: what is open is rounding's, and no evaluation tells more of it.
void core_seek_enter(const core_traced_ray ray, core_ray_clip clip, bool is_exact, bool is_blurred, elvis_real error,
                     inout core_segment segment) {
    const elvis_real begin = segment.begin, end = segment.end;
    const bool is_nothing = clip.possible_from > clip.possible_to;
    segment.last = end == segment.last ? (is_nothing ? begin : clip.possible_to) : segment.last;
    const bool is_joined = clip.sure_to >= end && segment.known_from <= end;
    segment.known_to = clip.is_sure && !is_joined ? clip.sure_to : segment.known_to;
    segment.known_from = clip.is_sure ? clip.sure_from : segment.known_from;
    const bool is_found = !is_nothing && clip.is_sure && (is_exact || clip.sure_from - clip.possible_from <= ray.tolerance);

    const elvis_real open_end = clip.is_sure ? clip.sure_from : clip.possible_to;
    const bool is_shrunk = open_end - clip.possible_from <= elvis_real(0.5LF) * (end - begin);
    const elvis_real middle = elvis_real(0.5LF) * (clip.possible_from + open_end);
    // Too short to matter, and not decided: left out.
    const bool is_left_out = !is_nothing && !is_found && (is_blurred || open_end - clip.possible_from <= ray.tolerance);
    const bool is_over = is_nothing || is_left_out;
    segment.is_touched = is_left_out;
    segment.enter = is_found ? clamp(clip.from, clip.possible_from, clip.sure_from) : is_left_out ? clip.possible_from : segment.enter;
    segment.enter_error = is_found ? error : is_left_out ? open_end - clip.possible_from : segment.enter_error;
    segment.enter_face = is_found ? clip.from_face : is_left_out ? CORE_NO_FACE : segment.enter_face;
    segment.is_inside = is_found;
    segment.begin = is_found ? segment.known_to : is_nothing ? end : is_left_out ? open_end : clip.possible_from;
    const bool is_bounded = segment.known_to == clip.sure_to && clip.possible_to < end;
    // Twice as far as what was decided.
    const elvis_real farther = min(segment.last, end + elvis_real(2) * (end - begin));
    segment.end = is_found ? (is_bounded ? clip.possible_to : segment.last) : is_over ? farther : is_shrunk ? open_end : middle;
#if ELVIS_HAS_INSIDE
    // The open interval may be due to rounding alone, along which faces do not bound: the search for the exit begins further inside.
    const elvis_real further = max(segment.known_to - elvis_real(4) * (segment.end - segment.known_to), clip.sure_from);
    segment.begin = is_found && is_bounded ? min(segment.begin, further) : segment.begin;
#endif
    segment.next = is_found || is_over || !clip.is_sure || !is_shrunk ? elvis_real(0.5LF) * (segment.begin + segment.end)
                                                              : clamp(clip.from, segment.begin, segment.end);
}

// Inside: where the ray leaves. True if that is found.
bool core_seek_leave(const core_traced_ray ray, core_ray_clip clip, bool is_exact, elvis_real error, inout core_segment segment) {
    const elvis_real begin = segment.begin, end = segment.end;
    const bool is_contradicted = clip.possible_from > min(clip.possible_to, begin + ray.tolerance);
    const bool is_continued = clip.is_sure && clip.sure_from <= begin + ray.tolerance;
    segment.last = end == segment.last && !is_contradicted ? clip.possible_to : segment.last;
    const bool is_all_inside = is_continued && clip.sure_to >= end;
    const bool is_last = is_all_inside && end >= segment.last;
    // Rounding may say that the ray is out already where it was surely inside.
    const bool is_at_begin = is_exact && clip.to <= begin + error && clip.to >= begin - error && clip.from <= clip.to;
    // Where nothing but the interval ends, the ray may go on.
    const bool is_cut_off = clip.to_face == CORE_NO_FACE && end < segment.last;
    const bool is_narrow = clip.possible_to - clip.sure_to <= ray.tolerance && !is_cut_off;
    const bool is_found = is_at_begin || (is_continued && !is_all_inside && (is_exact || is_narrow));
    const elvis_real open_begin = is_continued ? clip.sure_to : begin;
    const elvis_real open_end = is_continued ? clip.possible_to : min(clip.possible_to, elvis_real(0.5LF) * (begin + end));
    // Too short to matter, and not decided: as predicted.
    const bool is_short = !is_all_inside && !is_found && open_end - open_begin <= ray.tolerance;
    const elvis_real middle = elvis_real(0.5LF) * (open_begin + open_end);
    const bool is_passed = is_short && clip.from <= middle && clip.to >= middle && open_end < segment.last;
    const bool is_shrunk = open_end - open_begin <= elvis_real(0.5LF) * (end - begin);
    const bool is_over = is_contradicted || is_last || is_found || (is_short && !is_passed);
    segment.leave = is_at_begin       ? clip.to
                    : is_contradicted ? begin
                    : is_found        ? clamp(clip.to, clip.sure_to, clip.possible_to)
                    : is_last         ? end
                                      : open_begin;
    segment.leave_error = is_found ? error : ray.tolerance;
    segment.leave_face = is_found || is_short ? clip.to_face : CORE_NO_FACE;
    segment.resume = is_contradicted ? begin + ray.tolerance : is_found ? clip.possible_to : is_last ? end : open_end;
    segment.begin = is_all_inside ? end : is_passed ? open_end : open_begin;
    // Twice as far as what was decided.
    segment.end = is_all_inside ? min(segment.last, end + elvis_real(2) * (end - begin))
               : is_passed   ? min(segment.last, open_end + elvis_real(2) * ray.tolerance)
               : is_shrunk   ? open_end
                             : middle;
    segment.next = is_continued && is_shrunk && !is_all_inside && !is_passed ? clamp(clip.to, segment.begin, segment.end)
                                                             : elvis_real(0.5LF) * (segment.begin + segment.end);
    return is_over;
}
