/**
 * @file memory_limit.hpp
 * How much memory may be taken on a device, and how much has been.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace elvis {

/** There is no memory for something, or there may not be. */
class OutOfMemory : public Error {
public:
    using Error::Error;
};

/**
 * From now on, what would make all buffers together larger than this is an Error that says so. 0: what the device has. Small
 * memory that drivers take for themselves is not counted.
 */
void limit_memory(const Device& device, std::uint64_t bytes);

/** The most that all buffers together have taken since the last call of limit_memory. */
std::uint64_t peak_allocated_bytes(const Device& device);

/**
 * From now on, kernels and, on a processor, buffers are an OutOfMemory that would make the process hold more main memory than
 * this. 0: no limit. What is held already stays.
 */
void limit_process_memory(const Device& device, std::uint64_t bytes);

/**
 * Throws OutOfMemory unless there is room for another kernel, as large as any. Where there is little, those that are being made
 * come first, so that what they take is known. The kernel counts as being made as long as what is returned lives.
 */
[[nodiscard]] std::shared_ptr<void> need_kernel_room(const Device& device, const std::string& kernel);

/** Gives up pipelines that are kept for kernels to come (kernel/pipeline_pool.hpp). Any thread. */
void forget_pipelines(const Device& device);

} // namespace elvis
