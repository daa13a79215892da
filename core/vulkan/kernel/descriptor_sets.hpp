/**
 * @file descriptor_sets.hpp
 * Descriptor sets of one kernel: one for each dispatch that is not done yet.
 */
#pragma once

#include <core/vulkan/kernel/kernel_pipeline.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace elvis {

/** One thread at a time. */
class DescriptorSets {
public:
    /** Sets of `layout`, whose bindings are these; the layout must outlive what next() is called for. */
    DescriptorSets(VkDevice device, VkDescriptorSetLayout layout, const std::vector<BindingLayout>& bindings,
                   std::string place);
    ~DescriptorSets();
    DescriptorSets(const DescriptorSets&) = delete;
    DescriptorSets& operator=(const DescriptorSets&) = delete;

    /** One that nothing of this submission uses. Those of earlier ones are done. */
    VkDescriptorSet next(std::uint64_t submission);

private:
    void add_some();

    VkDevice m_device;
    VkDescriptorSetLayout m_layout;
    /** By type, in one set. */
    std::map<VkDescriptorType, std::uint32_t> m_counts;
    std::string m_place;
    std::vector<VkDescriptorPool> m_pools;
    std::vector<VkDescriptorSet> m_sets;
    std::size_t m_n_used = 0;
    std::uint64_t m_submission = 0;
};

} // namespace elvis
