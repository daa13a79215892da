// Counts of MFEM are of type int, those of arrays are not.
#pragma once

#include <cstddef>

namespace elvis_mfem {

/** i as an index; i >= 0. */
inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

} // namespace elvis_mfem
