// Whether the rays of a tile can come into an element through one of its faces without neighbour; for tiles/ray_tiles.comp.

#include "segments/ray_motion.glsl"

// Directions of rays lie in the hull of those at the tile's corners.
bool core_leaf_is_met(uint item, core_frustum frustum, vec2 span) {
    const core_linearization linearization = core_fetch_linearization(item);
    const elvis_real curvature = elvis_real(uintBitsToFloat(elvis_fetch_core_links(item, CORE_LINKS_CURVATURE)));
    core_ray_motion motions[4];
    for (int corner = 0; corner < 4; ++corner) {
        motions[corner] = core_motion_along(linearization, curvature, elvis_vec3(frustum.directions[corner]));
    }
    // The element's own boundary is anywhere in it.
    bool may_start = ELVIS_HAS_INSIDE == 1;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const bool leaves = core_surely_leaves(motions[0], item, face) && core_surely_leaves(motions[1], item, face) &&
                            core_surely_leaves(motions[2], item, face) && core_surely_leaves(motions[3], item, face);
        may_start = may_start || (elvis_fetch_core_links(item, uint(face)) == CORE_NO_LINK && !leaves);
    }
    return may_start;
}
