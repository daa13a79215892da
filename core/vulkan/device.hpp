/**
 * @file device.hpp
 * The Vulkan device that everything runs on. One compute queue; no surface is needed.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace elvis {

struct DeviceSummary {
    std::uint32_t index = 0;
    std::string name;
    std::string driver; ///< name and version text
    std::string type;   ///< "discrete", "integrated", "virtual", "cpu", "other"
    std::uint64_t memory_bytes = 0;
    bool has_float64 = false;
    /** Empty if usable, else why not (Vulkan below 1.3, no compute queue). */
    std::string unusable_because;
};

/** All devices of this machine in Vulkan's order. Empty if there is no Vulkan driver. */
std::vector<DeviceSummary> list_devices();

/**
 * The device ElVis would take: `wanted` (index or part of a name, case-insensitive), else $ELVIS_DEVICE, else the best by type (discrete,
 * integrated, virtual, cpu). Error that lists the devices if the wanted one does not exist.
 */
DeviceSummary choose_device(const std::string& wanted);

enum class Precision { float32, float64 };

class Device {
public:
    /** `validation`: load VK_LAYER_KHRONOS_validation with synchronisation checks; every message is logged and kept. */
    explicit Device(const std::string& wanted = {}, bool validation = false);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceSummary& summary() const;
    VkDevice handle() const;
    VkPhysicalDevice physical() const;
    const VkPhysicalDeviceLimits& limits() const;
    std::uint32_t subgroup_size() const;
    /** Bytes that one binding of the kind used for data may span. */
    std::uint64_t max_binding_bytes() const;
    /** Data buffers are read as texel buffers (fast on CPU drivers) rather than storage buffers (fast on GPUs). */
    bool uses_texel_buffers() const;
    /** Text that changes with device and driver, for cache keys. */
    std::string cache_key() const;
    /** Messages of the validation layer so far. */
    std::vector<std::string> validation_messages() const;

    /** Memory type index with these properties. */
    std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags properties) const;
    /** Bytes allocated on the device now, over all buffers. */
    std::uint64_t allocated_bytes() const;

    /** Records commands, submits them and waits. A lost device is an Error that says so. */
    void submit(const std::function<void(VkCommandBuffer)>& record) const;

    struct Impl;
    Impl& impl() const { return *m_impl; }

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
