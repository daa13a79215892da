// Points sheared so that a ray becomes an axis, as S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection" (2013): a point is
// moved in the same way whatever triangle or patch it belongs to.

#ifndef CORE_SURFACE_SHEAR
#define CORE_SURFACE_SHEAR

#include "arithmetic/precision.glsl"

elvis_real core_component(elvis_vec3 v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

// The direction in which the ray is steepest, the two others, and how a point is sheared along it so that the ray becomes an axis.
struct core_shear {
    uint kx, ky, kz;
    elvis_real scale, x, y;
};

core_shear core_shear_of(elvis_vec3 direction) {
    const elvis_vec3 steep = abs(direction);
    core_shear shear;
    shear.kz = steep.x >= steep.y && steep.x >= steep.z ? 0u : steep.y >= steep.z ? 1u : 2u;
    shear.kx = (shear.kz + 1u) % 3u;
    shear.ky = (shear.kz + 2u) % 3u;
    shear.scale = elvis_real(1) / core_component(direction, shear.kz);
    shear.x = core_component(direction, shear.kx) * shear.scale;
    shear.y = core_component(direction, shear.ky) * shear.scale;
    return shear;
}

elvis_vec3 core_sheared(core_shear shear, elvis_vec3 point) {
    const elvis_real z = core_component(point, shear.kz);
    precise const elvis_real x = core_component(point, shear.kx) - shear.x * z;
    precise const elvis_real y = core_component(point, shear.ky) - shear.y * z;
    return elvis_vec3(x, y, z);
}

#endif
