// Where a pixel's ray has got to on its way through the elements (segments/walk_state.glsl), with the light that it has gathered.

#ifndef CORE_VOLUME_STATE
#define CORE_VOLUME_STATE

#include "segments/walk_state.glsl"

struct core_volume_state {
    // Up to here light is settled; where the walk has got to; where it began, and the element in which it began.
    elvis_real done, walk, start;
    // How long the next step may be, where there was no time for all of an element; CORE_FAR if there was.
    elvis_real step;
    elvis_real red, green, blue, left, error;
    uint start_element;
    // Of all elements of the volume: the walk's next one; of a ray that seeks, that of the nearest start found so far, at `walk`.
    uint element;
    uint status;
    uint flags;
};

#endif
