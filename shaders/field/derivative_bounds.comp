// Largest size, slope and second derivatives of a field at samples of each element: estimates, for plugins that cannot tell. In pyramids,
// second derivatives count times (1 - xi_3)/2 (field/leaf_bounds.glsl).
//
// Samples lie in collapsed coordinates at a grid of 4 x 4 x 4 points, where polynomials are steepest near the ends. Second
// derivatives along each collapsed direction come from the difference to the gradient at a point CORE_STEP further inside. With the
// steps d_k in xi and the differences g_k of the gradients, the second derivatives are the matrix M with M d_k = g_k.
//
// A few points in a dispatch, from the first on: drivers end loops that take many iterations, those of an evaluation among them.

#include "element/expand.glsl"
#include "arithmetic/finite.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) buffer core_output {
    // Three an element: sum of second derivatives, sum of slopes, size. 3e38 stands for what is not finite.
    elvis_real core_largest[];
};
layout(push_constant) uniform core_parameters { uint core_first, core_n_elements, core_component, core_first_point, core_end_point; };

#define CORE_STEP elvis_real(0.1LF)
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define CORE_N_POINTS 16u
#else
#define CORE_N_POINTS 64u
#endif

// At the ends of directions that collapse, steps in xi are short, and rounding of the gradient would count a hundredfold.
#define CORE_END elvis_real(0.98LF)
#define CORE_COLLAPSED_END elvis_real(0.9LF)
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON || ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
#define CORE_ENDS elvis_vec3(CORE_END)
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM || ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#define CORE_ENDS elvis_vec3(CORE_END, CORE_END, CORE_COLLAPSED_END)
#else
#define CORE_ENDS elvis_vec3(CORE_END, CORE_COLLAPSED_END, CORE_COLLAPSED_END)
#endif

elvis_real core_sum(elvis_vec3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// One of the points, and where `direction` is 1, 2 or 3, beside it along that direction.
elvis_vec3 core_collapsed_point(uint place, uint direction) {
    const elvis_vec3 node = elvis_vec3(place & 3u, (place >> 2) & 3u, place >> 4);
    elvis_vec3 eta = node * (elvis_real(2) / elvis_real(3)) - elvis_vec3(1);
    eta.x *= CORE_END;
    eta.y = eta.y > elvis_real(0) ? eta.y * CORE_ENDS.y : eta.y * CORE_END;
    eta.z = eta.z > elvis_real(0) ? eta.z * CORE_ENDS.z : eta.z * CORE_END;
    eta.x += direction == 1u ? (eta.x > elvis_real(0) ? -CORE_STEP : CORE_STEP) : elvis_real(0);
    eta.y += direction == 2u ? (eta.y > elvis_real(0) ? -CORE_STEP : CORE_STEP) : elvis_real(0);
    eta.z += direction == 3u ? (eta.z > elvis_real(0) ? -CORE_STEP : CORE_STEP) : elvis_real(0);
    return eta;
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_elements) {
        return;
    }
    const elvis_real one = elvis_real(1);
    const elvis_real beyond = elvis_real(3.0e38LF);
    const bool is_first = core_first_point == 0u;
    elvis_real bend = is_first ? elvis_real(0) : core_largest[3u * index];
    elvis_real slope = is_first ? elvis_real(0) : core_largest[3u * index + 1u];
    elvis_real size = is_first ? elvis_real(0) : core_largest[3u * index + 2u];
    bool is_sound = max(max(bend, slope), size) < beyond;
    elvis_vec3 here = elvis_vec3(0), gradient_here = elvis_vec3(0);
    elvis_vec3 step1 = elvis_vec3(1, 0, 0), step2 = elvis_vec3(0, 1, 0), change1 = elvis_vec3(0), change2 = elvis_vec3(0);
    for (uint evaluation = 4u * core_first_point; evaluation < 4u * min(core_end_point, CORE_N_POINTS); ++evaluation) {
        const uint place = evaluation >> 2, direction = evaluation & 3u;
        const elvis_vec3 xi = core_expand(core_collapsed_point(place, direction));
        elvis_real value;
        elvis_vec3 gradient;
        elvis_field_gradient(core_first + index, xi, core_component, value, gradient);
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
        gradient.z = elvis_real(0);
        const bool has_third = false;
#else
        const bool has_third = true;
#endif
        is_sound = is_sound && core_is_finite(value) && core_is_finite(gradient.x) && core_is_finite(gradient.y) &&
                   core_is_finite(gradient.z);
        size = max(size, abs(value));
        slope = max(slope, core_sum(gradient));
        here = direction == 0u ? xi : here;
        gradient_here = direction == 0u ? gradient : gradient_here;
        const elvis_vec3 change = gradient - gradient_here;
        step1 = direction == 1u ? xi - here : step1;
        change1 = direction == 1u ? change : change1;
        step2 = direction == 2u ? xi - here : step2;
        change2 = direction == 2u ? change : change2;
        const elvis_vec3 step3 = has_third ? xi - here : elvis_vec3(0, 0, 1);
        // M = sum of change_k times row k of the inverse of the matrix with columns step_k.
        const elvis_vec3 normal1 = cross(step2, step3), normal2 = cross(step3, step1), normal3 = cross(step1, step2);
        const elvis_real volume = direction == 3u ? dot(step1, normal1) : one;
        const elvis_vec3 column1 = (normal1.x * change1 + normal2.x * change2 + normal3.x * change) / volume;
        const elvis_vec3 column2 = (normal1.y * change1 + normal2.y * change2 + normal3.y * change) / volume;
        const elvis_vec3 column3 = (normal1.z * change1 + normal2.z * change2 + normal3.z * change) / volume;
        const elvis_real share = ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID ? elvis_real(0.5LF) * (one - here.z) : one;
        const elvis_real sum = share * (core_sum(column1) + core_sum(column2) + core_sum(column3));
        is_sound = is_sound && (direction != 3u || core_is_finite(sum));
        bend = direction == 3u ? max(bend, sum) : bend;
    }
    core_largest[3u * index] = is_sound ? bend : beyond;
    core_largest[3u * index + 1u] = is_sound ? slope : beyond;
    core_largest[3u * index + 2u] = is_sound ? size : beyond;
}
