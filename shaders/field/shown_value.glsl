// What a surface shows. The kernel brings core_first_component and core_end_component.

// An expression brings its own core_shown_value, and whether it rests on estimates (core/expression/glsl.hpp).
#ifndef CORE_SHOWN_BY_EXPRESSION
#define CORE_VALUE_FLAGS 0u
// The component, or the length of the vector of several.
elvis_real core_shown_value(uint element, elvis_vec3 xi) {
    elvis_real value = elvis_field_value(element, xi, core_first_component);
#if ELVIS_N_COMPONENTS > 1
    elvis_real sum = value * value;
    for (uint component = core_first_component + 1u; component < core_end_component; ++component) {
        const elvis_real other = elvis_field_value(element, xi, component);
        sum += other * other;
    }
    value = core_end_component - core_first_component > 1u ? sqrt(sum) : value;
#endif
    return value;
}
#endif
