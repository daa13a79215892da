/**
 * @file pipeline_pool.hpp
 * Pipelines that live on for the next kernel of the same code.
 */
#pragma once

#include <core/vulkan/kernel/kernel_pipeline.hpp>

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace elvis {

/**
 * Passes go with the field, time step or data that they were made for; those of the next one have the same code. A driver takes
 * up to seconds to make a pipeline, even from its cache. Any thread.
 */
class PipelinePool {
public:
    using Pipeline = std::shared_ptr<const KernelPipeline>;

    /** Pipelines that were asked for last are kept, also if nobody has them. */
    static constexpr std::size_t most = 128;

    /** That of the key, which says all that goes into it; made if there is none. */
    Pipeline find_or_make(const std::string& key, const std::function<Pipeline()>& make);
    void clear();

private:
    Pipeline found(const std::string& key);

    std::mutex m_mutex;
    /** Asked for last first. */
    std::list<std::pair<std::string, Pipeline>> m_pipelines;
};

} // namespace elvis
