// Regula falsi, Illinois variant: the zero of a function between two points at which its signs differ. The value at an end that stays
// counts half the next time, so that both ends come nearer.

#ifndef CORE_ILLINOIS
#define CORE_ILLINOIS

struct core_bracket {
    elvis_real low, high, at_low, at_high;
};

bool core_has_sign_change(core_bracket bracket) { return (bracket.at_low < elvis_real(0)) != (bracket.at_high < elvis_real(0)); }

// The end where the function is nearer to zero.
elvis_real core_better_end(core_bracket bracket) { return abs(bracket.at_low) < abs(bracket.at_high) ? bracket.low : bracket.high; }

elvis_real core_secant_fraction(core_bracket bracket) { return bracket.at_low / (bracket.at_low - bracket.at_high); }

// Where the function is wanted next: at a fraction of the bracket. Every third step halves.
elvis_real core_next_place(core_bracket bracket, uint step, elvis_real fraction) {
    return bracket.low + (step % 3u == 2u ? elvis_real(0.5LF) : fraction) * (bracket.high - bracket.low);
}

void core_take_value(elvis_real place, elvis_real value, inout core_bracket bracket) {
    const bool is_low = (value < elvis_real(0)) == (bracket.at_low < elvis_real(0));
    bracket.at_high = is_low ? elvis_real(0.5LF) * bracket.at_high : value;
    bracket.at_low = is_low ? value : elvis_real(0.5LF) * bracket.at_low;
    bracket.low = is_low ? place : bracket.low;
    bracket.high = is_low ? bracket.high : place;
}

#endif
