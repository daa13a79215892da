#include <core/base/cache.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>

namespace elvis {

PipelineCache::PipelineCache(VkDevice device, const std::string& device_key)
    : m_device(device), m_entry(content_hash(device_key) + ".pipelines") {
    const auto stored = read_cache_entry(m_entry);
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    if (stored) {
        // The driver checks the header (vendor, device, UUID) itself and ignores what is not its own.
        info.initialDataSize = stored->size();
        info.pInitialData = stored->data();
        m_bytes_on_disk = stored->size();
    }
    check_vulkan(vkCreatePipelineCache(m_device, &info, nullptr, &m_cache), "Vulkan", "creating the pipeline cache");
}

PipelineCache::~PipelineCache() {
    std::size_t bytes = 0;
    if (vkGetPipelineCacheData(m_device, m_cache, &bytes, nullptr) == VK_SUCCESS && bytes > m_bytes_on_disk) {
        std::vector<std::byte> data(bytes);
        if (vkGetPipelineCacheData(m_device, m_cache, &bytes, data.data()) == VK_SUCCESS) {
            write_cache_entry(m_entry, std::span(data).first(bytes));
        }
    }
    vkDestroyPipelineCache(m_device, m_cache, nullptr);
}

} // namespace elvis
