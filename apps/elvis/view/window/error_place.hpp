// Where errors of this folder say that they happened.
#pragma once

namespace elvis::view {

inline constexpr const char* error_place = "window";

} // namespace elvis::view
