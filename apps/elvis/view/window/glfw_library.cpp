#include "glfw_library.hpp"

namespace elvis::view {

const LateLibrary& glfw_library() {
    static const LateLibrary library("libglfw.so.3");
    return library;
}

} // namespace elvis::view
