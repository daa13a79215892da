/**
 * @file lighting.hpp
 * Light on surfaces. Colours are display values, taken, added and clamped as they are.
 */
#pragma once

#include <array>
#include <vector>

namespace elvis {

struct Light {
    enum class Type {
        directional, ///< the same direction everywhere, as from the sun
        point,       ///< from a place; no weaker farther away
    };
    Type type = Type::directional;
    /** The direction in which the light travels (of any length but zero), or its place. World coordinates. */
    std::array<double, 3> vector{};
    /** Display values, >= 0; above 1 for a light that is stronger than the surface's own colour. */
    std::array<double, 3> color{1, 1, 1};
};

/**
 * A pixel whose surface has colour c and unit normal n, on the viewer's side, is drawn as
 *     clamp(c (ambient + sum of L_i max(0, n.l_i)) + specular sum of L_i (n.h_i)^exponent, 0, 1),
 * l_i the unit vector towards light i of colour L_i, h_i = unit(l_i + v), v towards the viewer, highlights only of lights with
 * n.l_i > 0 (Blinn 1977). The headlight is at the eye, or in the direction of view of an orthographic camera: l = v.
 */
struct Lighting {
    /** Where the surface faces the viewer, both add up to its own colour. */
    std::array<double, 3> ambient{0.3, 0.3, 0.3};
    std::array<double, 3> headlight{0.7, 0.7, 0.7};
    std::vector<Light> lights;
    /** Strength of highlights, >= 0. */
    double specular = 0;
    /** > 0. */
    double exponent = 30;
};

/** What shaders/picture/lighting.glsl reads: rows of four numbers, places relative to `reference`. */
std::vector<double> lighting_rows(const Lighting& lighting, const std::array<double, 3>& reference);

} // namespace elvis
