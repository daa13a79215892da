// Where a ray has got to (segments/walk_state.glsl), with what is to be told of its segments.

#ifndef CORE_RAY_SEGMENT_STATE
#define CORE_RAY_SEGMENT_STATE

#include "segments/walk_state.glsl"

struct core_segment_state {
    core_walk_state walk;
    // Bounds of the errors of walk.done and walk.at.
    elvis_real done_error, at_error;
    // Of the segments' lengths, as parameters.
    elvis_real sum;
    // In the ray's list.
    uint n_segments;
    // Whether walk.done rests on an estimate.
    uint is_estimated;
};

#endif
