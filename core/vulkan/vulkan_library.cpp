#include <core/vulkan/vulkan_library.hpp>

namespace elvis {

const LateLibrary& vulkan_library() {
    static const LateLibrary library("libvulkan.so.1");
    return library;
}

std::string why_no_devices() {
    if (!vulkan_library().is_there()) {
        return "this machine has no Vulkan loader (" + vulkan_library().missing_because() +
               "); install it (package libvulkan1, vulkan-loader or vulkan-icd-loader) and a driver";
    }
    return "this machine has no Vulkan driver that can be loaded (VK_LOADER_DEBUG=error in the environment tells what fails); "
           "without a GPU, install a driver for the CPU (Debian package mesa-vulkan-drivers)";
}

} // namespace elvis
