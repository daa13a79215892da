/**
 * @file color_space.hpp
 * Interpolation between two display colours.
 *
 * Lab: CIE L*a*b* of sRGB with white D65. Diverging: K. Moreland, "Diverging Color Maps for Scientific Visualization" (2009),
 * polar Lab with a white middle where both ends are saturated and far apart in hue. HSV: the shorter way round the hues.
 */
#pragma once

#include <core/scene/scene.hpp>

namespace elvis {

/** Colour at `t` in [0, 1] between two colours, clamped to [0, 1]. */
Rgb interpolate(ColorSpace space, const Rgb& from, const Rgb& to, double t);

} // namespace elvis
