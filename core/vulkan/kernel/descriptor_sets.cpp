#include <core/vulkan/check.hpp>
#include <core/vulkan/kernel/descriptor_sets.hpp>

#include <algorithm>
#include <utility>

namespace elvis {

DescriptorSets::DescriptorSets(VkDevice device, VkDescriptorSetLayout layout, const std::vector<BindingLayout>& bindings,
                               std::string place)
    : m_device(device), m_layout(layout), m_place(std::move(place)) {
    for (const BindingLayout& binding : bindings) {
        ++m_counts[descriptor_type(binding.type)];
    }
}

DescriptorSets::~DescriptorSets() {
    for (const VkDescriptorPool pool : m_pools) {
        vkDestroyDescriptorPool(m_device, pool, nullptr);
    }
}

void DescriptorSets::add_some() {
    // Most kernels run once or twice between two looks at results.
    const auto n = static_cast<std::uint32_t>(std::max<std::size_t>(1, m_sets.size()));
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : m_counts) {
        sizes.push_back({type, n * count});
    }
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = n;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check_vulkan(vkCreateDescriptorPool(m_device, &pool_info, nullptr, &pool), m_place, "creating its descriptors");
    m_pools.push_back(pool);
    const std::vector<VkDescriptorSetLayout> layouts(n, m_layout);
    VkDescriptorSetAllocateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set_info.descriptorPool = pool;
    set_info.descriptorSetCount = n;
    set_info.pSetLayouts = layouts.data();
    std::vector<VkDescriptorSet> sets(n);
    check_vulkan(vkAllocateDescriptorSets(m_device, &set_info, sets.data()), m_place, "creating its descriptors");
    m_sets.insert(m_sets.end(), sets.begin(), sets.end());
}

VkDescriptorSet DescriptorSets::next(std::uint64_t submission) {
    if (submission != m_submission) {
        m_submission = submission;
        m_n_used = 0;
    }
    if (m_n_used == m_sets.size()) {
        add_some();
    }
    return m_sets[m_n_used++];
}

} // namespace elvis
