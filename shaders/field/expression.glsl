// What the text of an expression (core/expression/glsl.hpp) calls beyond arithmetic and arithmetic/math.glsl.

#ifndef CORE_EXPRESSION
#define CORE_EXPRESSION

#include "arithmetic/whole_power.glsl"

// A component over the length of its vector: the length's derivative, taken as 0 where the length is 0.
elvis_real core_over_length(elvis_real a, elvis_real length_) {
    return length_ == elvis_real(0) ? elvis_real(0) : a / length_;
}

#endif
