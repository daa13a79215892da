// Taylor models of what jumps: comparisons, choices, signs. Where a jump may lie in the region, nothing is said.

#ifndef CORE_MODEL_CHOICE
#define CORE_MODEL_CHOICE

// 1 or 0 where f is certainly less than g, or certainly not.
core_model core_model_less(core_model f, core_model g, core_region region) {
    const core_model difference = core_model_subtract(g, f, region);
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(difference, region);
    const core_model decided = core_model_constant(difference.value > elvis_real(0) ? elvis_real(1) : elvis_real(0));
    return core_model_choose(abs(difference.value) > reach, decided, core_model_unknown());
}
core_model core_model_less_equal(core_model f, core_model g, core_region region) { return core_model_less(f, g, region); }
core_model core_model_equal(core_model f, core_model g, core_region region) {
    const core_model difference = core_model_subtract(g, f, region);
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(difference, region);
    return core_model_choose(abs(difference.value) > reach, core_model_constant(elvis_real(0)), core_model_unknown());
}

core_model core_model_select(core_model condition, core_model f, core_model g, core_region region) {
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(condition, region);
    const bool is_true = abs(condition.value) > reach;
    // Comparisons give exact numbers; nothing else is known to be 0.
    const bool is_false = condition.value == elvis_real(0) && reach < elvis_real(0.5LF);
    return core_model_choose(is_true, f, core_model_choose(is_false, g, core_model_unknown()));
}

core_model core_model_sign(core_model f, core_region region) {
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(f, region);
    return core_model_choose(abs(f.value) > reach, core_model_constant(sign(f.value)), core_model_unknown());
}

core_model core_model_over_length(core_model f, core_model length_, core_region region) { return core_model_divide(f, length_, region); }

core_model core_model_power_to(core_model f, elvis_real p, core_region region) { return core_model_power(f, p, region); }

// A coordinate of an affine mapping. Its computed value and slope lose a few units in the last place of what they are sums of,
// which is no more than the position and the Jacobian's entries together.
core_model core_model_coordinate(elvis_real x, elvis_vec3 slope, core_region region) {
    const elvis_real size = abs(x) + elvis_real(3) * core_model_norm1(slope);
    const elvis_real error = elvis_real(16) * CORE_ROUNDOFF * size;
    return core_model_leaf(x, slope, elvis_vec3(0, error, error), region);
}

#endif
