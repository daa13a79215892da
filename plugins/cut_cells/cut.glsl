// Cells that are cut: only where the level set is not positive there is anything of them.
//
// A record of `level` is the level set's polynomial in rows like those of `modes`, then a row with the bounds of its slope and bend.

#include "cell.glsl"

void elvis_inside(uint element, elvis_vec3 xi, out elvis_real g, out elvis_vec3 gradient) {
    CUTCELLS_EVALUATE(elvis_fetch4_level, element, 0u, CUTCELLS_LEVEL_ORDER, xi, g, gradient)
}

elvis_vec2 elvis_inside_bounds(uint element) {
    return elvis_fetch4_level(element, uint((CUTCELLS_LEVEL_ORDER + 1) * (CUTCELLS_LEVEL_ORDER + 1))).xy;
}
