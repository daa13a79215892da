// Intervals of what expressions have beyond arithmetic/interval.glsl: comparisons (1 or 0), choices, signs, lengths.

#ifndef CORE_INTERVAL_CHOICE
#define CORE_INTERVAL_CHOICE

core_interval core_interval_truth(bool is_certain, bool is_impossible) {
    return core_interval(is_certain ? elvis_real(1) : elvis_real(0), is_impossible ? elvis_real(0) : elvis_real(1));
}
core_interval core_interval_less(core_interval a, core_interval b) {
    return core_interval_truth(a.upper < b.lower, a.lower >= b.upper);
}
core_interval core_interval_less_equal(core_interval a, core_interval b) {
    return core_interval_truth(a.upper <= b.lower, a.lower > b.upper);
}
core_interval core_interval_equal(core_interval a, core_interval b) {
    return core_interval_truth(false, a.lower > b.upper || a.upper < b.lower);
}

core_interval core_interval_select(core_interval condition, core_interval a, core_interval b) {
    const elvis_real zero = elvis_real(0);
    const bool is_true = condition.lower > zero || condition.upper < zero;
    const bool is_false = condition.lower == zero && condition.upper == zero;
    const core_interval either = core_interval_union(a, b);
    return core_interval(is_true ? a.lower : is_false ? b.lower : either.lower, is_true ? a.upper : is_false ? b.upper : either.upper);
}

core_interval core_interval_sign(core_interval a) { return core_interval(sign(a.lower), sign(a.upper)); }

core_interval core_interval_length(core_interval a, core_interval b, core_interval c) {
    return core_interval_sqrt(
        core_interval_add(core_interval_add(core_interval_square(a), core_interval_square(b)), core_interval_square(c)));
}

core_interval core_interval_over_length(core_interval a, core_interval length_) {
    const core_interval quotient = core_interval_divide(a, length_);
    return core_interval(max(quotient.lower, elvis_real(-1)), min(quotient.upper, elvis_real(1)));
}

core_interval core_interval_power_to(core_interval a, elvis_real p) { return core_interval_power(a, core_interval_near(p)); }

#endif
