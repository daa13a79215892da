// Where a ray has got to (segments/walk_state.glsl), with what is to be told of its segments.

#ifndef CORE_RAY_SEGMENT_STATE
#define CORE_RAY_SEGMENT_STATE

#include "segments/walk_state.glsl"

struct core_segment_state {
    elvis_real done, walk, start;
    // Bounds of the errors of the first two.
    elvis_real done_error, walk_error;
    // Of the segments' lengths, as parameters.
    elvis_real sum;
    uint start_element, element;
    uint status, flags;
    // In the ray's list.
    uint n_segments;
    // Whether `done` rests on an estimate.
    uint is_estimated;
};

#endif
