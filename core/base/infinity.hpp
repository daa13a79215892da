// infinity, by a short name.
#pragma once

#include <limits>

namespace elvis {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace elvis
