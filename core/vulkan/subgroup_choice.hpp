/**
 * @file subgroup_choice.hpp
 * How many lanes share an instruction.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace elvis {

struct SubgroupChoice {
    /** Lanes of a subgroup. */
    std::uint32_t size = 0;
    /** What pipelines have to ask for to get it; 0: nothing, it is what the driver takes. */
    std::uint32_t required = 0;
};

SubgroupChoice choose_subgroup(VkPhysicalDevice device);

} // namespace elvis
