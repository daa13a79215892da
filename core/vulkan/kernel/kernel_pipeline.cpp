#include <core/vulkan/kernel/kernel_pipeline.hpp>

#include <core/vulkan/check.hpp>

namespace elvis {

VkDescriptorType descriptor_type(BindingType type) {
    switch (type) {
    case BindingType::uniform_buffer:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingType::texel_buffer:
        return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    default:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
}

KernelPipeline::KernelPipeline(VkDevice device, std::span<const std::uint32_t> spirv, std::span<const BindingLayout> layout,
                               std::uint32_t push_constant_bytes, const Options& options, const std::string& place)
    : m_device(device) {
    try {
        create_layouts(layout, push_constant_bytes, place);
        create_pipeline(spirv, options, place);
    } catch (...) {
        release();
        throw;
    }
}

KernelPipeline::~KernelPipeline() { release(); }

void KernelPipeline::release() noexcept {
    vkDestroyPipeline(m_device, m_pipeline, nullptr);
    vkDestroyPipelineLayout(m_device, m_layout, nullptr);
    vkDestroyDescriptorSetLayout(m_device, m_set_layout, nullptr);
}

void KernelPipeline::create_layouts(std::span<const BindingLayout> layout, std::uint32_t push_constant_bytes,
                                    const std::string& place) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const auto& binding : layout) {
        bindings.push_back({binding.binding, descriptor_type(binding.type), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    check_vulkan(vkCreateDescriptorSetLayout(m_device, &set_info, nullptr, &m_set_layout), place, "creating its layout");

    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_constant_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &m_set_layout;
    info.pushConstantRangeCount = push_constant_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    check_vulkan(vkCreatePipelineLayout(m_device, &info, nullptr, &m_layout), place, "creating its layout");
}

void KernelPipeline::create_pipeline(std::span<const std::uint32_t> spirv, const Options& options, const std::string& place) {
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check_vulkan(vkCreateShaderModule(m_device, &module_info, nullptr, &module), place, "loading its code");

    VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size_info{};
    size_info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO;
    size_info.requiredSubgroupSize = options.subgroup_size;
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT | options.flags;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.pNext = options.subgroup_size != 0 ? &size_info : nullptr;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = m_layout;
    const VkResult result = vkCreateComputePipelines(m_device, options.cache, 1, &info, nullptr, &m_pipeline);
    vkDestroyShaderModule(m_device, module, nullptr);
    check_vulkan(result, place, "building it");
}

} // namespace elvis
