// Light that a surface reflects, as core/render/picture/lighting.hpp states it: two-sided diffuse light, and highlights by the half vector
// (J. F. Blinn, Models of light reflection for computer synthesized pictures, SIGGRAPH 1977).
//
// The kernel defines CORE_LIGHTS_BINDING.

#ifndef CORE_LIGHTING
#define CORE_LIGHTING

#include "arithmetic/read_only.glsl"

// ambient and number of lights; strength and exponent of highlights; then for each light its vector and kind, and its colour.
// Places are relative to the reference point of the rays.
layout(set = 0, binding = CORE_LIGHTS_BINDING) CORE_READ_ROWS(core_lights);

#define CORE_LIGHT_AT_EYE elvis_real(0)
#define CORE_LIGHT_FROM_DIRECTION elvis_real(1)

// `to_viewer` and `normal` are of unit length; the normal may point to either side.
elvis_vec3 core_lit(elvis_vec3 color, elvis_vec3 normal, elvis_vec3 position, elvis_vec3 to_viewer) {
    const elvis_real zero = elvis_real(0);
    const elvis_real facing = dot(normal, to_viewer);
    // Where a surface has no normal, as in the tip of a cone, it is lit as if it faced the viewer.
    const bool has_normal = facing >= elvis_real(-2) && facing <= elvis_real(2) && dot(normal, normal) > elvis_real(0.5LF);
    const elvis_vec3 n = has_normal ? (facing < zero ? -normal : normal) : to_viewer;

    const elvis_vec4 ambient = CORE_ROW(core_lights, 0);
    const elvis_real strength = CORE_ROW(core_lights, 1).x, exponent = CORE_ROW(core_lights, 1).y;
    elvis_real red = color.x * ambient.x, green = color.y * ambient.y, blue = color.z * ambient.z;
    const uint n_lights = uint(ambient.w);
    for (uint light = 0u; light < n_lights; ++light) {
        const elvis_vec4 source = CORE_ROW(core_lights, 2u + 2u * light);
        const elvis_vec3 light_color = CORE_ROW(core_lights, 3u + 2u * light).xyz;
        const elvis_vec3 from_place = source.xyz - position;
        const elvis_real distance = length(from_place);
        const elvis_vec3 to_place = distance > zero ? from_place / distance : n;
        const elvis_vec3 to_light =
            source.w == CORE_LIGHT_AT_EYE ? to_viewer : source.w == CORE_LIGHT_FROM_DIRECTION ? source.xyz : to_place;
        const elvis_real diffuse = dot(n, to_light);
        const bool is_lit = diffuse > zero;
        elvis_real highlight = zero;
        if (is_lit && strength > zero) {
            // Both lie on the normal's side: the sum does not vanish.
            const elvis_real cosine = dot(n, normalize(to_light + to_viewer));
            highlight = strength * elvis_pow(clamp(cosine, zero, elvis_real(1)), exponent);
        }
        const elvis_real share = is_lit ? diffuse : zero;
        red += light_color.x * (color.x * share + highlight);
        green += light_color.y * (color.y * share + highlight);
        blue += light_color.z * (color.z * share + highlight);
    }
    return clamp(elvis_vec3(red, green, blue), elvis_vec3(0), elvis_vec3(1));
}

#endif
