// Where a pixel's ray has got to on its way through the elements (segments/walk_state.glsl), with the light that it has gathered.

#ifndef CORE_VOLUME_STATE
#define CORE_VOLUME_STATE

#include "segments/walk_state.glsl"
#include "volume/volume_light.glsl"

struct core_volume_state {
    core_walk_state walk;
    // How long the next step may be, where there was no time for all of an element; CORE_FAR if there was.
    elvis_real step;
    core_light light;
};

#endif
