// Of kernels whose invocations draw columns of pixels, at most 16 of them: marks all pixels of one where the driver has given up. It may
// have ended the loop over rows, and would end one over marks, too: so there is none.
//
// The kernel brings core_marks and core_size.

#include "arithmetic/driver_limit.glsl"

#ifndef CORE_ROWS
#define CORE_ROWS CORE_TILE_HEIGHT
#endif

#define CORE_DISTRUST(i)                                                                  \
    if (i < CORE_ROWS && first_row + i < end_row) {                                       \
        core_marks[(first_row + i) * core_size.x + column].flags |= CORE_FLAG_WORK_LIMIT; \
    }

// Nothing with end_row = first_row.
void core_distrust_column(uint column, uint first_row, uint end_row) {
    CORE_DISTRUST(0u)
    CORE_DISTRUST(1u)
    CORE_DISTRUST(2u)
    CORE_DISTRUST(3u)
    CORE_DISTRUST(4u)
    CORE_DISTRUST(5u)
    CORE_DISTRUST(6u)
    CORE_DISTRUST(7u)
    CORE_DISTRUST(8u)
    CORE_DISTRUST(9u)
    CORE_DISTRUST(10u)
    CORE_DISTRUST(11u)
    CORE_DISTRUST(12u)
    CORE_DISTRUST(13u)
    CORE_DISTRUST(14u)
    CORE_DISTRUST(15u)
}

// The same for a column whose rows before `row` have been drawn, unless the driver has given up (arithmetic/driver_limit.glsl).
void core_distrust_column(uint column, uint first_row, uint row, uint end_row, uint zero) {
    const bool is_cut_short = row < end_row || core_has_driver_given_up(zero);
    core_distrust_column(column, first_row, is_cut_short ? end_row : first_row);
}
