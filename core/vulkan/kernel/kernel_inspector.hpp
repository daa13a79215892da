/**
 * @file kernel_inspector.hpp
 * What a device's compiler makes of a kernel: registers, spills, waves. Nothing runs, so the device needs no memory.
 */
#pragma once

#include <core/vulkan/device.hpp>
#include <core/vulkan/kernel/kernel_pipeline.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace elvis {

/** As the driver tells, in its own count; nothing where it does not. */
struct KernelStatistics {
    /** Vector registers of a lane. */
    std::optional<std::uint64_t> registers;
    /** Values kept in scratch memory for want of vector registers. */
    std::optional<std::uint64_t> spills;
    /** Bytes of scratch memory of a wave (a lane, on NVIDIA): spilled values and arrays that are indexed at run time. */
    std::optional<std::uint64_t> scratch_bytes;
    /** Subgroups that a processor holds at once, to work on one while others wait for memory. */
    std::optional<std::uint64_t> waves;
    /** Of machine code. */
    std::optional<std::uint64_t> code_bytes;
    std::uint32_t subgroup_size = 0;
    /** Of the driver's compiler; next to nothing if the driver has it in a cache of its own. */
    double milliseconds = 0;
};

class KernelInspector {
public:
    /** As for choose_device, and of the devices that only compile those that are named. */
    explicit KernelInspector(const std::string& wanted);
    ~KernelInspector();
    KernelInspector(const KernelInspector&) = delete;
    KernelInspector& operator=(const KernelInspector&) = delete;

    const DeviceSummary& summary() const;
    /** What kernels are to be written for, to be asked about here. */
    DataBuffers data_buffers() const;
    std::uint32_t subgroup_size() const;
    /** The driver tells more than how long it took. */
    bool tells() const;

    KernelStatistics inspect(const KernelCode& code) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
