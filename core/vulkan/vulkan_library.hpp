/**
 * @file vulkan_library.hpp
 * The Vulkan loader of the machine. Programs start without it: the functions of vulkan.h load it.
 */
#pragma once

#include <core/late_library/late_library.hpp>

namespace elvis {

const LateLibrary& vulkan_library();

/** What a machine without devices lacks, and what to do about it. */
std::string why_no_devices();

} // namespace elvis
