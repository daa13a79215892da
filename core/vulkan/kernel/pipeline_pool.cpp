#include <core/vulkan/kernel/pipeline_pool.hpp>

#include <algorithm>

namespace elvis {

PipelinePool::Pipeline PipelinePool::found(const std::string& key) {
    const auto at = std::ranges::find(m_pipelines, key, &std::pair<std::string, Pipeline>::first);
    if (at == m_pipelines.end()) {
        return nullptr;
    }
    m_pipelines.splice(m_pipelines.begin(), m_pipelines, at);
    return at->second;
}

PipelinePool::Pipeline PipelinePool::find_or_make(const std::string& key, const std::function<Pipeline()>& make) {
    {
        const std::lock_guard lock(m_mutex);
        if (Pipeline pipeline = found(key)) {
            return pipeline;
        }
    }
    // Others make theirs meanwhile.
    Pipeline made = make();
    Pipeline forgotten; // Goes after the lock.
    const std::lock_guard lock(m_mutex);
    if (Pipeline pipeline = found(key)) {
        return pipeline;
    }
    m_pipelines.emplace_front(key, made);
    if (m_pipelines.size() > most) {
        forgotten = std::move(m_pipelines.back().second);
        m_pipelines.pop_back();
    }
    return made;
}

void PipelinePool::clear() {
    const std::lock_guard lock(m_mutex);
    m_pipelines.clear();
}

} // namespace elvis
