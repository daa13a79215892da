// What cuts elements (element/inside.glsl) as if it were the shown field, over all of their reference shapes: its isosurface 0 is their own
// boundary. Elements that are not cut have -1. It is drawn as if nothing were cut away, since it lies where that begins.
//
// Stands where the text of an expression does (core/expression/glsl.hpp).

#define CORE_SHOWN_BY_EXPRESSION 1
#define CORE_VALUE_FLAGS 0u
#include "arithmetic/model.glsl"
#include "field/leaf_bounds.glsl"

void core_shown_gradient(uint element, elvis_vec3 xi, out elvis_real value, out elvis_vec3 gradient) {
#if ELVIS_HAS_INSIDE
    elvis_inside(element, xi, value, gradient);
#else
    value = elvis_real(-1);
    gradient = elvis_vec3(0);
#endif
}

elvis_real core_shown_value(uint element, elvis_vec3 xi) {
    elvis_real value;
    elvis_vec3 gradient;
    core_shown_gradient(element, xi, value, gradient);
    return value;
}

core_model core_shown_model(uint element, elvis_vec3 xi, core_region region, out elvis_real value) {
    elvis_vec3 gradient;
    core_shown_gradient(element, xi, value, gradient);
#if ELVIS_HAS_INSIDE
    const elvis_vec2 bounds = elvis_inside_bounds(element);
#else
    const elvis_vec2 bounds = elvis_vec2(0);
#endif
    return core_model_leaf(value, gradient, core_leaf_bounds(elvis_vec4(bounds.y, bounds.x, abs(value) + bounds.x, 0), xi, region.radius),
                           region);
}

bool core_is_model_estimated(uint element) { return false; }

#include "element/whole_elements.glsl"
