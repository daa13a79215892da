/**
 * @file kernel.hpp
 * A compute pipeline with its bindings.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/kernel/kernel_pipeline.hpp>

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace elvis {

/** How many buffers of each type a kernel has. */
struct BufferCounts {
    std::uint32_t uniform = 0, storage = 0;
};

/** Uniform buffers from binding 0 on, behind them storage buffers. */
std::vector<BindingLayout> buffer_bindings(const BufferCounts& counts);

/** One descriptor: a whole buffer, or one part of a record buffer. */
struct BoundBuffer {
    std::uint32_t binding = 0;
    const Buffer* buffer = nullptr;
    const RecordBuffer* records = nullptr;
    std::uint32_t part = 0;
};

class Kernel {
public:
    /** `spirv` from the compiler (core/shader/compiler.hpp). Uses the device's pipeline cache, which is kept on disk. */
    Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::vector<BindingLayout> layout,
           std::uint32_t push_constant_bytes, std::string name);
    ~Kernel();
    Kernel(Kernel&&) noexcept;
    Kernel& operator=(Kernel&&) noexcept;

    /**
     * Runs with these bindings and push constants: whoever reads a buffer afterwards sees what it has written. Every binding of
     * the layout must be given. Groups: number of work groups in x, y, z; zero in any is nothing to do. They are given to the
     * device in parts of bounded time, from the first to the last (dispatch_pace.hpp), in which gl_WorkGroupID counts from the
     * first of all and gl_NumWorkGroups is that of the part. Throws Cancelled between parts if this thread's task is to stop
     * (DeviceTask).
     */
    void dispatch(std::span<const BoundBuffer> bindings, std::span<const std::byte> push_constants, std::uint32_t groups_x,
                  std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) const;
    /** The same for a box of groups: gl_WorkGroupID counts from `first`. */
    void dispatch_from(const std::array<std::uint32_t, 3>& first, std::span<const BoundBuffer> bindings,
                       std::span<const std::byte> push_constants, const std::array<std::uint32_t, 3>& groups) const;

    /** The same for as many groups as the first three words of `size` say when it is its turn, all at once. */
    void dispatch_indirect(std::span<const BoundBuffer> bindings, std::span<const std::byte> push_constants,
                           const Buffer& size) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
