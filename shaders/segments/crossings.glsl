// Finds where a polynomial takes isovalues, in order along the segment. Volume rendering meets breakpoints in volume/volume_exact.glsl.
// Before it the kernel brings
//     elvis_real core_listed_value(uint i)     an ascending list.
//
// The segment is divided dyadically, depth first, without a stack: an interval is [index, index + 1] / 2^level, and its coefficients are
// always those of the whole segment, restricted. An interval with no listed value within its range, widened by the error E, is done with:
// it is verified that the field does not take them. An interval where the polynomial is monotone, or has one value in reach and one
// change of sign about it, is settled: crossings there are known one by one (Descartes' rule in the Bernstein basis: Collins & Akritas
// 1976; Rouillier & Zimmermann 2004). So is one whose range is no wider than 2 E: there the polynomial does not know better. All others
// are halved.

#ifndef CORE_FIT_CROSSINGS
#define CORE_FIT_CROSSINGS

#include "segments/bernstein.glsl"

#define CORE_CROSSING_NONE 0u
// The field itself crosses: at the ends of the bracket it is on both sides of the value by more than E.
#define CORE_CROSSING_VERIFIED 1u
// The polynomial crosses, but comes closer than E at an end of the bracket.
#define CORE_CROSSING_PROBABLE 2u
// The polynomial comes as close as E: a touch, or a crossing beside an end. Only the field can tell.
#define CORE_CROSSING_TOUCH 3u

// A double root takes as many levels as half the digits. Intervals of the last level are taken as settled.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_ISOLATION_LEVELS 30u
#else
#define CORE_ISOLATION_LEVELS 16u
#endif
// Regula falsi with the Illinois rule gains a digit and a half in two iterations once near; more are a multiple root's.
#define CORE_ROOT_ITERATIONS 48u

// The interval at hand, and how many of its crossings have been found before.
struct core_isolation {
    uint level, index, rank;
};

struct core_crossing {
    uint kind;
    // In the list.
    uint index;
    elvis_real t;
    // Of the interval in which it lies: no other crossing of this value is in there, unless it is a touch.
    elvis_real lower, upper;
};

core_isolation core_isolation_begin() { return core_isolation(0u, 0u, 0u); }

bool core_isolation_is_over(core_isolation isolation) { return isolation.level == 0u && isolation.index != 0u; }

// The next interval of the same size, or that of which it is the left end.
void core_isolation_next(inout core_isolation isolation) {
    const uint next = isolation.index + 1u;
    const uint up = uint(findLSB(next));
    isolation.index = next >> up;
    isolation.level -= up;
    isolation.rank = 0u;
}

// Number of listed values below x. `with_x`: counts values equal to x, too.
uint core_count_below(elvis_real x, bool with_x, uint n_values) {
    uint first = 0u, last = n_values;
    while (first < last) {
        const uint middle = (first + last) / 2u;
        const elvis_real value = core_listed_value(middle);
        const bool is_below = value < x || (with_x && value == x);
        first = is_below ? middle + 1u : first;
        last = is_below ? last : middle;
    }
    return first;
}

// Root of p - value in [0, 1], which has different signs at the ends (or zero at the second).
elvis_real core_polynomial_root(core_polynomial p, elvis_real value) {
    elvis_real a = elvis_real(0), b = elvis_real(1);
    elvis_real fa = p.c[0] - value, fb = p.c[CORE_FIT_DEGREE] - value;
    elvis_real x = fa == elvis_real(0) ? a : b, fx = fa == elvis_real(0) ? fa : fb;
    elvis_real step = elvis_real(1);
    for (uint iteration = 0u; iteration < CORE_ROOT_ITERATIONS && fx != elvis_real(0) && step > elvis_real(4) * CORE_ROUNDOFF;
         ++iteration) {
        const elvis_real last = x;
        x = a + (b - a) * (fa / (fa - fb));
        fx = core_bernstein_value(p, x) - value;
        const bool is_first = (fx < elvis_real(0)) == (fb < elvis_real(0));
        // The end that stays for a second time counts half.
        fa = is_first ? (iteration > 0u && (last == b) ? elvis_real(0.5LF) * fa : fa) : fx;
        fb = is_first ? fx : (iteration > 0u && (last == a) ? elvis_real(0.5LF) * fb : fb);
        a = is_first ? a : x;
        b = is_first ? x : b;
        step = abs(x - last);
    }
    return x;
}

// The crossing that is next in isolation's interval, if there is one; moves isolation on. Its parameter is that in the interval; of a
// verified or probable crossing it is found later (core_polynomial_root).
core_crossing core_look_at(core_polynomial restricted, elvis_real error, uint n_values, inout core_isolation isolation) {
    const uint level = isolation.level, place = isolation.index;
    const elvis_real first = restricted.c[0], last = restricted.c[CORE_FIT_DEGREE];
    const elvis_real least = core_least(restricted), most = core_most(restricted);
    const uint n_below = core_count_below(least - error, false, n_values);
    const uint n_reached = core_count_below(most + error, true, n_values) - n_below;

    const bool has_value = isolation.rank < n_reached, rises = first < last;
    const uint index = rises ? n_below + isolation.rank : n_below + n_reached - 1u - isolation.rank;
    const elvis_real value = core_listed_value(has_value ? index : 0u);
    const elvis_real from = first - value, to = last - value;
    const bool is_clear = abs(from) > error && abs(to) > error;
    const bool is_small = most - least <= elvis_real(2) * error || level == CORE_ISOLATION_LEVELS;
    const bool is_isolated = n_reached == 1u && is_clear && core_variations(restricted, value) == 1u;
    const bool is_settled = is_small || is_isolated || core_is_monotone(restricted);

    // A value met at the beginning of an interval belongs to the interval before.
    const elvis_real zero = elvis_real(0);
    const bool crosses = (from < zero && to >= zero) || (from > zero && to <= zero) || (from == zero && to != zero && place == 0u);
    // Monotone, and stops within E of the value, or starts there: at the end of the segment, or at what may be an extremum.
    const bool stops = rises ? to < zero : to > zero;
    const bool touches = is_small || stops || place == 0u;
    const bool found = has_value && is_settled && (crosses || touches);
    core_crossing crossing;
    crossing.kind = !found ? CORE_CROSSING_NONE
                    : !crosses ? CORE_CROSSING_TOUCH
                    : is_clear ? CORE_CROSSING_VERIFIED
                               : CORE_CROSSING_PROBABLE;
    crossing.index = found ? index : 0u;
    crossing.t = is_small ? elvis_real(0.5LF) : stops ? elvis_real(1) : elvis_real(0);

    const bool has_more = isolation.rank + 1u < n_reached;
    if (has_value && !is_settled) {
        isolation.level += 1u;
        isolation.index *= 2u;
        isolation.rank = 0u;
    } else if (has_value && has_more) {
        isolation.rank += 1u;
    } else {
        core_isolation_next(isolation);
    }
    return crossing;
}

// The first crossing from `isolation` on; `error` is E, at least core_bernstein_rounding.
core_crossing core_next_crossing(core_polynomial bernstein, elvis_real error, uint n_values, inout core_isolation isolation) {
    core_crossing crossing;
    crossing.kind = CORE_CROSSING_NONE;
    crossing.index = 0u;
    crossing.t = elvis_real(0);
    uint level = 0u, place = 0u;
    core_polynomial restricted = bernstein;
    while (crossing.kind == CORE_CROSSING_NONE && !core_isolation_is_over(isolation)) {
        level = isolation.level;
        place = isolation.index;
        restricted = core_restricted(bernstein, level, place);
        crossing = core_look_at(restricted, error, n_values, isolation);
    }
    const elvis_real size = crossing.kind == CORE_CROSSING_NONE ? elvis_real(0) : elvis_real(1) / elvis_real(1u << level);
    if (crossing.kind == CORE_CROSSING_VERIFIED || crossing.kind == CORE_CROSSING_PROBABLE) {
        crossing.t = core_polynomial_root(restricted, core_listed_value(crossing.index));
    }
    crossing.t = (elvis_real(place) + crossing.t) * size;
    crossing.lower = elvis_real(place) * size;
    crossing.upper = elvis_real(place + 1u) * size;
    return crossing;
}

#endif
