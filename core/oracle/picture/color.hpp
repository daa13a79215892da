/**
 * @file color.hpp
 * Colour of a value, in double precision.
 */
#pragma once

#include <core/render/frame.hpp>

namespace elvis::oracle {

/** A step (two points of equal value) shows its upper colour at the value itself. */
Color color_of(const ColorTable& table, double value);

} // namespace elvis::oracle
