/**
 * @file device.hpp
 * The Vulkan device that everything runs on. One compute queue; no surface is needed.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/vulkan/precision.hpp>

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
    /** "0000:01:00.0": domain, bus, device and function. Empty where the driver does not say. */
    std::string pci_bus_id;
    /** "6d657361-3232-2e33-2e36-000000000000". The same in every process. Empty where the driver does not say. */
    std::string uuid;
    /** It has no memory, but its driver compiles kernels: a stand-in for hardware that is not there. */
    bool only_compiles = false;
    /** Empty if usable, else why not (Vulkan below 1.3, no compute queue, no memory). */
    std::string unusable_because;
};

/** All devices of this machine in Vulkan's order. Empty if there is no Vulkan driver. */
std::vector<DeviceSummary> list_devices();

/**
 * The device ElVis would take: `wanted` (index, PCI bus id, UUID or part of a name, all case-insensitive; an id may lack its
 * domain 0000 and a UUID its dashes), else $ELVIS_DEVICE, else the best by type (discrete, integrated, virtual, cpu). Error
 * that lists the devices if the wanted one does not exist.
 */
DeviceSummary choose_device(const std::string& wanted);

class Background;
struct KernelCode;

/** How long a kernel has run, over all its parts. */
struct KernelTime {
    std::string kernel;
    double milliseconds = 0;
};

/** What making a kernel took. */
struct KernelBuild {
    std::string kernel;
    /** From GLSL to SPIR-V, or reading it from the cache. */
    double compiler_milliseconds = 0;
    /** From SPIR-V to what the device runs. Drivers may put off a part until the kernel first runs. */
    double driver_milliseconds = 0;
    /** Of SPIR-V. */
    std::uint64_t code_bytes = 0;
};

/** How often work was handed to the device, and how often this side waited for it. */
struct DeviceWork {
    std::uint64_t submissions = 0, host_waits = 0;
};

/** What data buffers are for shaders. */
enum class DataBuffers { automatic, texel, storage };

/**
 * When the device is given what it is to do. single: each kernel alone, in parts of bounded time, so that drivers' time limits
 * are kept, a window's work comes in between, and a task can be stopped. collected: all until a result is wanted.
 */
enum class Submissions { automatic, single, collected };

struct DeviceOptions {
    /** As for choose_device. */
    std::string wanted;
    /** Load VK_LAYER_KHRONOS_validation with synchronisation checks; every message is kept, and memory starts as NaN. */
    bool validation = false;
    /** automatic: texel buffers on CPU drivers, where they are fast, storage buffers elsewhere. */
    DataBuffers data_buffers = DataBuffers::automatic;
    /** Upper limit for max_binding_bytes(), to test what happens to large data; 0: only the device's own. */
    std::uint64_t max_binding_bytes = 0;
    /** Lanes of a subgroup that kernels are written for; 0: the device's own. To draw with the kernels of another device. */
    std::uint32_t subgroup_size = 0;
    /** Called with every kernel that is composed, from several threads at once; may be empty. */
    std::function<void(const KernelCode&)> on_kernel;
    /** automatic: collected on graphics cards, single elsewhere. */
    Submissions submissions = Submissions::automatic;
    /** Copy through a staging buffer even where the device's memory can be mapped. */
    bool always_stage = false;

    /**
     * The options of $ELVIS_VALIDATION (1), $ELVIS_DATA_BUFFERS (texel, storage), $ELVIS_MAX_BINDING_BYTES (a number),
     * $ELVIS_STAGING (1), and $ELVIS_SUBMISSIONS (single, collected). An Error if one has no meaning.
     */
    static DeviceOptions from_environment(std::string wanted = {});
};

/**
 * A device with one compute queue. All functions may be called from several threads at once; submissions take turns. Buffers
 * and kernels made with it must not outlive it.
 */
class Device {
public:
    /** With the options of the environment; `validation` turns validation on. */
    explicit Device(const std::string& wanted = {}, bool validation = false);
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceSummary& summary() const;
    VkDevice handle() const;
    VkPhysicalDevice physical() const;
    const VkPhysicalDeviceLimits& limits() const;
    std::uint32_t subgroup_size() const;
    /** Whether commands are collected before they are submitted (Submissions). */
    bool collects_submissions() const;
    /** Bytes that one binding of the kind used for data may span. */
    std::uint64_t max_binding_bytes() const;
    /** Data buffers are read as texel buffers (fast on CPU drivers) rather than storage buffers (fast on GPUs). */
    bool uses_texel_buffers() const;
    /** The validation layer is loaded. */
    bool is_validated() const;
    /** Text that changes with device and driver, for cache keys. */
    std::string cache_key() const;
    /** Messages of the validation layer so far. */
    std::vector<std::string> validation_messages() const;

    /** Bytes allocated on the device now, over all buffers. */
    std::uint64_t allocated_bytes() const;
    /** Buffers and kernels that exist now, to tell what grows. */
    std::uint64_t n_buffers() const;
    std::uint64_t n_kernels() const;

    /** So far, by all threads. */
    DeviceWork work() const;

    /** Records commands, which see what those before have written, and are done at the latest when finish() returns. */
    void record(const std::function<void(VkCommandBuffer)>& record) const;
    /** Waits until all that was recorded has been done. Buffers that are read do so by themselves. A lost device is an Error.
     */
    void finish() const;

    /** Throws Cancelled if this thread's task is to stop (DeviceTask). Kernels ask before each part of their work. */
    void check_task() const;

    /** Threads that compile kernels for it. */
    Background& background() const;
    /** Of the kernels made so far, in the order in which they were ready. */
    std::vector<KernelBuild> kernel_builds() const;
    void add(KernelBuild build) const;
    /** Of the kernels that have run so far, in the order of their names. A first run may include a part of the driver's work.
     */
    std::vector<KernelTime> kernel_times() const;
    /** DeviceOptions::on_kernel */
    void tell(const KernelCode& code) const;

    /** For the other files of core/vulkan. */
    struct Impl;
    Impl& impl() const { return *m_impl; }

private:
    std::unique_ptr<Impl> m_impl;
};

/**
 * While it lives, what this thread runs on the device belongs to a task, which can be cancelled: then kernels stop before the
 * next part of their work and throw Cancelled, with what they have written so far in their buffers.
 */
class DeviceTask {
public:
    /** Null: the task stays as it is. Device and control must outlive this. */
    DeviceTask(const Device& device, const TaskControl* control);
    ~DeviceTask();
    DeviceTask(const DeviceTask&) = delete;
    DeviceTask& operator=(const DeviceTask&) = delete;

private:
    const Device& m_device;
    const TaskControl* m_before;
};

} // namespace elvis
