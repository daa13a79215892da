// What a surface shows as a Taylor model over a pixel's region. The kernel brings core_first_component and core_end_component, and
// the host's buffer core_bounds: for each element and component the bounds of second and first derivatives and of the size of the
// field, and whether they are estimated.

#include "arithmetic/model.glsl"

#include "field/leaf_bounds.glsl"

// An expression brings its own (core/expression/glsl.hpp).
#ifndef CORE_SHOWN_BY_EXPRESSION

// `value`: what core_shown_value gives, also where there is no model.
core_model core_component_model(uint element, elvis_vec3 xi, uint component, core_region region, out elvis_real value) {
    elvis_vec3 gradient;
    elvis_field_gradient(element, xi, component, value, gradient);
    const elvis_vec3 bounds = core_leaf_bounds(elvis_fetch4_core_bounds(element, component), xi, region.radius);
    return core_model_leaf(value, gradient, bounds, region);
}

core_model core_shown_model(uint element, elvis_vec3 xi, core_region region, out elvis_real value) {
    core_model model = core_component_model(element, xi, core_first_component, region, value);
#if ELVIS_N_COMPONENTS > 1
    core_model square = core_model_square(model, region);
    elvis_real sum = value * value;
    for (uint component = core_first_component + 1u; component < core_end_component; ++component) {
        elvis_real other;
        const core_model next = core_component_model(element, xi, component, region, other);
        square = core_model_add(square, core_model_square(next, region), region);
        sum += other * other;
    }
    const bool is_length = core_end_component - core_first_component > 1u;
    model = core_model_choose(is_length, core_model_sqrt(square, region), model);
    value = is_length ? sqrt(sum) : value;
#endif
    return model;
}

// What the value at a point is off at most.
elvis_real core_shown_rounding(uint element, elvis_vec3 xi) {
    elvis_real sum = elvis_real(0);
    for (uint component = core_first_component; component < core_end_component; ++component) {
        sum += core_leaf_bounds(elvis_fetch4_core_bounds(element, component), xi, elvis_real(0)).y;
    }
    return sum;
}

// Bound of second derivatives within `radius` of xi; of the length of a vector, none without a model.
elvis_real core_shown_bend(uint element, elvis_vec3 xi, elvis_real radius) {
    const elvis_real bend = core_leaf_bounds(elvis_fetch4_core_bounds(element, core_first_component), xi, radius).x;
    return core_end_component - core_first_component > 1u ? CORE_UNKNOWN : bend;
}

bool core_is_model_estimated(uint element) {
    bool is_estimated = false;
    for (uint component = core_first_component; component < core_end_component; ++component) {
        is_estimated = is_estimated || elvis_fetch4_core_bounds(element, component).w > elvis_real(0);
    }
    return is_estimated;
}

#else

// Of an expression none is known without a model.
elvis_real core_shown_bend(uint element, elvis_vec3 xi, elvis_real radius) { return CORE_UNKNOWN; }

// Of an expression: what its model leaves over a region that is a point.
elvis_real core_shown_rounding(uint element, elvis_vec3 xi) {
    const elvis_vec3 here = elvis_vec3(0);
    elvis_real value;
    return core_shown_model(element, xi, core_region(here, here, here, here, elvis_real(0), elvis_real(0)), value).remainder;
}

#endif
