/**
 * @file memory_limit.hpp
 * How much memory may be taken on a device, and how much has been.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <cstdint>

namespace elvis {

/**
 * From now on, what would make all buffers together larger than this is an Error that says so. 0: what the device has. Small
 * memory that drivers take for themselves is not counted.
 */
void limit_memory(const Device& device, std::uint64_t bytes);

/** The most that all buffers together have taken since the last call of limit_memory. */
std::uint64_t peak_allocated_bytes(const Device& device);

} // namespace elvis
