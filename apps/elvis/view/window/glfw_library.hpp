/**
 * @file glfw_library.hpp
 * GLFW, which windows need and nothing else: the functions of glfw3.h load it.
 */
#pragma once

#include <core/late_library/late_library.hpp>

namespace elvis::view {

const LateLibrary& glfw_library();

} // namespace elvis::view
