/**
 * @file kernel_pipeline.hpp
 * Code made into what a device runs.
 */
#pragma once

#include <core/vulkan/precision.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis {

/** What stands at one binding of set 0: exactly one descriptor each. */
enum class BindingType { storage_buffer, uniform_buffer, texel_buffer };

struct BindingLayout {
    std::uint32_t binding = 0;
    BindingType type = BindingType::storage_buffer;
};

VkDescriptorType descriptor_type(BindingType type);

/** All that a driver is given to compile. */
struct KernelCode {
    std::string name;
    /** Path below shaders/ without its ending, e.g. "cut_surface/cut_plane". */
    std::string file;
    Precision precision = Precision::float32;
    std::vector<std::uint32_t> spirv;
    std::vector<BindingLayout> layout;
    std::uint32_t push_constant_bytes = 0;
};

/** A compute pipeline and its layouts. */
class KernelPipeline {
public:
    struct Options {
        VkPipelineCache cache = VK_NULL_HANDLE;
        VkPipelineCreateFlags flags = 0;
        /** Lanes of a subgroup; 0: as the driver likes. */
        std::uint32_t subgroup_size = 0;
    };

    /** `place`: for errors. */
    KernelPipeline(VkDevice device, std::span<const std::uint32_t> spirv, std::span<const BindingLayout> layout,
                   std::uint32_t push_constant_bytes, const Options& options, const std::string& place);
    ~KernelPipeline();
    KernelPipeline(const KernelPipeline&) = delete;
    KernelPipeline& operator=(const KernelPipeline&) = delete;

    VkDescriptorSetLayout set_layout() const { return m_set_layout; }
    VkPipelineLayout layout() const { return m_layout; }
    VkPipeline handle() const { return m_pipeline; }

private:
    void create_layouts(std::span<const BindingLayout> layout, std::uint32_t push_constant_bytes, const std::string& place);
    void create_pipeline(std::span<const std::uint32_t> spirv, const Options& options, const std::string& place);
    void release() noexcept;

    VkDevice m_device;
    VkDescriptorSetLayout m_set_layout = VK_NULL_HANDLE;
    VkPipelineLayout m_layout = VK_NULL_HANDLE;
    VkPipeline m_pipeline = VK_NULL_HANDLE;
};

} // namespace elvis
