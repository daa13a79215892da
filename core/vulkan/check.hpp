/**
 * @file check.hpp
 * Vulkan result codes become errors here.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace elvis {

/** "VK_ERROR_DEVICE_LOST (...)": the code's name and, where it helps, what it means for the user. */
std::string vulkan_result_text(VkResult result);

/** An Error at `place` saying that `activity` failed, unless the result is VK_SUCCESS. */
void check_vulkan(VkResult result, const std::string& place, const char* activity);

} // namespace elvis
