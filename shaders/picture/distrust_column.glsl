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
#define CORE_DISTRUST_FOUR(i) CORE_DISTRUST(i) CORE_DISTRUST(i + 1u) CORE_DISTRUST(i + 2u) CORE_DISTRUST(i + 3u)

// Nothing with end_row = first_row.
void core_distrust_column(uint column, uint first_row, uint end_row) {
    CORE_DISTRUST_FOUR(0u)
    CORE_DISTRUST_FOUR(4u)
    CORE_DISTRUST_FOUR(8u)
    CORE_DISTRUST_FOUR(12u)
}

// The same if the loop over rows was ended at `row`, or another loop somewhere (arithmetic/driver_limit.glsl: `zero`).
void core_distrust_column(uint column, uint first_row, uint row, uint end_row, uint zero) {
    const bool is_cut_short = row < end_row || core_has_driver_given_up(zero);
    core_distrust_column(column, first_row, is_cut_short ? end_row : first_row);
}
