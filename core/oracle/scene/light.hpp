/**
 * @file light.hpp
 * Light on a surface, by the formula of core/render/picture/lighting.hpp.
 */
#pragma once

#include <core/oracle/element/reference_shape.hpp>

#include <core/render/frame.hpp>

namespace elvis::oracle {

/** `normal` and `to_viewer` of unit length. */
Color lit(const Lighting& lighting, const Color& color, const Vector& normal, const Vector& position, const Vector& to_viewer);

} // namespace elvis::oracle
