// The part of the reference shape that an element has, where its class says so: where g(xi) <= 0 (elvis_inside in
// plugin_api/glsl_interface.md). Without ELVIS_HAS_INSIDE it is all of the shape, and there is nothing here.
//
// From a point of the shape to another one g departs from its tangent by no more than its second derivatives allow, of which the
// class knows a bound:
//
//     |g(xi + d) - value - slope . d| <= bend |d|^2 / 2 + tilt |d| + rounding   in the maximum norm,
//
// where tilt is rounding of the slope.
//
// So g is one more face, not flat but bent by a known amount. Its number is the one after the faces of the shape; no neighbour is known
// there.

#ifndef CORE_INSIDE
#define CORE_INSIDE

#include "field/leaf_bounds.glsl"
#include "arithmetic/precision.glsl"

#define CORE_INSIDE_FACE CORE_N_FACES
#define CORE_N_SIDES (CORE_N_FACES + ELVIS_HAS_INSIDE)

#if ELVIS_HAS_INSIDE

struct core_inside {
    elvis_real value;
    elvis_vec3 slope;
    elvis_real bend, tilt, rounding;
};

core_inside core_inside_at(uint element, elvis_vec3 xi) {
    core_inside g;
    elvis_inside(element, xi, g.value, g.slope);
    const elvis_vec2 bounds = elvis_inside_bounds(element);
    g.bend = bounds.y;
    // Of values as large as the shape leaves room for.
    g.rounding = CORE_VALUE_ROUNDING * (abs(g.value) + bounds.x);
    g.tilt = CORE_GRADIENT_ROUNDING * bounds.x;
    return g;
}

// What the tangent may be off within this distance, beside the value's rounding. No two points of the shape are farther apart than 2.
elvis_real core_inside_bend(core_inside g, elvis_real distance) {
    const elvis_real d = min(distance, elvis_real(2));
    return (elvis_real(0.5LF) * g.bend * d + g.tilt) * d;
}

// Whether the point is not outside for certain. `xi_error`: of its coordinates.
bool core_is_within(uint element, elvis_vec3 xi, elvis_vec3 xi_error) {
    const core_inside g = core_inside_at(element, xi);
    return g.value <= dot(abs(g.slope), xi_error) + g.rounding;
}

#endif

#endif
