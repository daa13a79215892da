// The isovalues, ascending, as buffer core_isovalues and number core_n_isovalues, which the kernel brings. One with
// CORE_HAS_ONE_ISOVALUE saves loops over them; core_begin_isovalues comes first.

#ifndef CORE_ISOVALUES
#define CORE_ISOVALUES

#ifndef CORE_HAS_ONE_ISOVALUE
#define CORE_HAS_ONE_ISOVALUE 0
#endif

#if CORE_HAS_ONE_ISOVALUE

#define CORE_N_ISOVALUES 1u
elvis_real core_only_isovalue;
void core_begin_isovalues() { core_only_isovalue = CORE_REAL(core_isovalues, 0u); }
elvis_real core_isovalue_at(uint i) { return core_only_isovalue; }
uint core_isovalue_from(elvis_real least) { return core_only_isovalue < least ? 1u : 0u; }
uint core_isovalues_end(uint first, elvis_real most) { return first == 0u && core_only_isovalue <= most ? 1u : first; }

#else

#define CORE_N_ISOVALUES core_n_isovalues
void core_begin_isovalues() {}
elvis_real core_isovalue_at(uint i) { return CORE_REAL(core_isovalues, i); }

// The first that is at least `least`.
uint core_isovalue_from(elvis_real least) {
    uint low = 0u, high = core_n_isovalues;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        const bool is_below = CORE_REAL(core_isovalues, middle) < least;
        low = is_below ? middle + 1u : low;
        high = is_below ? high : middle;
        if (low >= high) {
            break;
        }
    }
    return low;
}

// One after the last that is at most `most`.
uint core_isovalues_end(uint first, elvis_real most) {
    uint end = first;
    while (end < core_n_isovalues && CORE_REAL(core_isovalues, end) <= most) {
        end += 1u;
    }
    return end;
}

#endif

#endif
