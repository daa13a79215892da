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

/**
 * What the driver takes, but 32 where that is less and may be chosen (Vulkan 1.3, AMD's RDNA, which would take 64): rays of
 * neighbouring pixels go different ways, and what one of them does all wait for. Scratch memory of a wave is halved, too.
 */
SubgroupChoice choose_subgroup(VkPhysicalDevice device);

} // namespace elvis
