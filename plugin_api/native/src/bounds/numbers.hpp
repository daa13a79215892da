// Numbers of double precision that bounds are made of.
#pragma once

#include <limits>

namespace elvis::native {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
/** The unit roundoff: the largest relative error of one operation. */
inline constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

} // namespace elvis::native
