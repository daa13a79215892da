#include <core/vulkan/kernel/kernel.hpp>

#include <core/base/cache.hpp>
#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>
#include <core/vulkan/kernel/descriptor_sets.hpp>
#include <core/vulkan/kernel/dispatch_pace.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

namespace elvis {

namespace {

void check_limit(std::size_t needed, std::uint32_t limit, const std::string& place, const char* what) {
    if (needed > limit) {
        throw Error(place, "it needs " + std::to_string(needed) + " " + what + ", the device allows " + std::to_string(limit));
    }
}

/** Groups of which fewer leave parts of the device idle. */
std::uint64_t groups_at_once(const Device& device) {
    // Any real GPU has fewer than 256 processors, with room for some groups each.
    constexpr std::uint64_t of_gpu = 1024;
    return device.summary().type == "cpu" ? std::max(1u, std::thread::hardware_concurrency()) : of_gpu;
}

std::shared_ptr<DispatchPace> pace_on(const Device& device) {
    return std::make_shared<DispatchPace>(groups_at_once(device), device.collects_submissions()
                                                                      ? DispatchPace::wanted_collected_milliseconds
                                                                      : DispatchPace::wanted_milliseconds);
}

/** All that a pipeline of a device depends on. */
std::string key_of(std::span<const std::uint32_t> spirv, std::span<const BindingLayout> layout, std::uint32_t push_bytes) {
    const auto bytes = std::as_bytes(spirv);
    std::string key = content_hash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    for (const BindingLayout& binding : layout) {
        key += ' ' + std::to_string(binding.binding) + ':' + std::to_string(static_cast<int>(binding.type));
    }
    return key + ' ' + std::to_string(push_bytes);
}

using Groups = std::array<std::uint32_t, 3>;

/** A box of work groups. */
struct DispatchPart {
    Groups first{}, count{};

    std::uint64_t n_groups() const { return std::uint64_t{count[0]} * count[1] * count[2]; }
};

/** The part that follows the first `done` groups of `all`, x running fastest: whole layers, rows of one layer, or a piece of a
 * row. */
DispatchPart next_part(const Groups& all, std::uint64_t done, std::uint64_t n_wanted) {
    const std::uint64_t row = all[0], layer = row * all[1];
    DispatchPart part;
    part.first = {static_cast<std::uint32_t>(done % row), static_cast<std::uint32_t>(done / row % all[1]),
                  static_cast<std::uint32_t>(done / layer)};
    part.count = {all[0] - part.first[0], 1, 1};
    if (part.first[0] > 0 || n_wanted < row) {
        part.count[0] = static_cast<std::uint32_t>(std::min<std::uint64_t>(part.count[0], n_wanted));
    } else if (part.first[1] > 0 || n_wanted < layer) {
        part.count[1] = static_cast<std::uint32_t>(std::min<std::uint64_t>(all[1] - part.first[1], n_wanted / row));
    } else {
        part.count[1] = all[1];
        part.count[2] = static_cast<std::uint32_t>(std::min<std::uint64_t>(all[2] - part.first[2], n_wanted / layer));
    }
    return part;
}

std::uint64_t most_bytes(const VkPhysicalDeviceLimits& limits, BindingType type) {
    constexpr std::uint64_t texel_bytes = 16;
    switch (type) {
    case BindingType::uniform_buffer:
        return limits.maxUniformBufferRange;
    case BindingType::texel_buffer:
        return texel_bytes * limits.maxTexelBufferElements;
    default:
        return limits.maxStorageBufferRange;
    }
}

const BoundBuffer& bound_at(std::span<const BoundBuffer> bindings, std::uint32_t binding) {
    const auto found = std::ranges::find(bindings, binding, &BoundBuffer::binding);
    assert(found != bindings.end() && (found->buffer != nullptr) != (found->records != nullptr));
    return *found;
}

} // namespace

struct Kernel::Impl {
    const Device& device;
    std::vector<BindingLayout> layout;
    std::uint32_t push_constant_bytes;
    std::string name, place;
    PipelinePool::Pipeline pipeline;
    /** With the pipeline, whose layout they have; none if there is nothing to bind. */
    std::shared_ptr<DescriptorSets> sets;
    /** It has not run. */
    std::atomic<bool> is_new = true;
    /** Guards the order of a dispatch's parts. */
    std::mutex mutex;
    /** Also of dispatches that are under way when the kernel ends. */
    std::shared_ptr<DispatchPace> pace;

    Impl(const Device& on, std::vector<BindingLayout> bindings, std::uint32_t push_bytes, std::string called)
        : device(on), layout(std::move(bindings)), push_constant_bytes(push_bytes), name(std::move(called)),
          place("kernel '" + name + "' on " + on.impl().place()), pace(pace_on(on)) {
        ++device.impl().n_kernels;
    }

    ~Impl() {
        --device.impl().n_kernels;
        device.impl().queue->when_done([held = std::pair(std::move(sets), std::move(pipeline))]() mutable { held = {}; });
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::uint32_t count(BindingType type) const {
        return static_cast<std::uint32_t>(
            std::count_if(layout.begin(), layout.end(), [type](const BindingLayout& binding) { return binding.type == type; }));
    }

    void check_limits() const;
    void create_pipeline(std::span<const std::uint32_t> spirv) {
        Device::Impl& on = device.impl();
        pipeline = on.kept_pipelines.find_or_make(key_of(spirv, layout, push_constant_bytes), [&] {
            return std::make_shared<const KernelPipeline>(
                device.handle(), spirv, layout, push_constant_bytes,
                KernelPipeline::Options{.cache = on.pipelines->handle(), .subgroup_size = on.required_subgroup_size}, place);
        });
    }
    void check_bindings(std::span<const BoundBuffer> bindings) const;
    /** Bound in a set of its own. */
    VkDescriptorSet bound(std::span<const BoundBuffer> bindings);
    /** `dispatch`: the command itself. */
    void run(const CommandQueue::Record& dispatch, std::span<const BoundBuffer> bindings,
             std::span<const std::byte> push_constants, CommandQueue::Took took);
    void run_in_parts(const Groups& first, const Groups& groups, std::span<const BoundBuffer> bindings,
                      std::span<const std::byte> push_constants);
};

void Kernel::Impl::check_limits() const {
    const VkPhysicalDeviceLimits& limits = device.limits();
    check_limit(count(BindingType::storage_buffer), limits.maxPerStageDescriptorStorageBuffers, place, "storage buffers");
    check_limit(count(BindingType::texel_buffer), limits.maxPerStageDescriptorSampledImages, place, "texel buffers");
    check_limit(count(BindingType::uniform_buffer), limits.maxPerStageDescriptorUniformBuffers, place, "uniform buffers");
    check_limit(layout.size(), limits.maxPerStageResources, place, "buffers");
    check_limit(push_constant_bytes, limits.maxPushConstantsSize, place, "bytes of push constants");
}

void Kernel::Impl::check_bindings(std::span<const BoundBuffer> bindings) const {
    const VkPhysicalDeviceLimits& limits = device.limits();
    for (const BindingLayout& binding : layout) {
        const Buffer* const buffer = bound_at(bindings, binding.binding).buffer;
        const std::uint64_t limit = most_bytes(limits, binding.type);
        if (buffer != nullptr && buffer->bytes() > limit) {
            throw Error(place, "a buffer of " + std::to_string(buffer->bytes()) + " bytes at binding " +
                                   std::to_string(binding.binding) + ", the device binds at most " + std::to_string(limit));
        }
    }
}

// The set is written anew for each dispatch (about a microsecond): comparing handles would not tell a buffer from a later one
// whose handle happens to be the same.
VkDescriptorSet Kernel::Impl::bound(std::span<const BoundBuffer> bindings) {
    const VkDescriptorSet set = sets->next(device.impl().queue->submission());
    std::vector<VkDescriptorBufferInfo> buffers(layout.size());
    std::vector<VkBufferView> views(layout.size(), VK_NULL_HANDLE);
    std::vector<VkWriteDescriptorSet> writes(layout.size());
    for (std::size_t i = 0; i < layout.size(); ++i) {
        const BindingLayout& binding = layout[i];
        const BoundBuffer& bound = bound_at(bindings, binding.binding);
        if (bound.records != nullptr) {
            buffers[i] = {bound.records->part(bound.part), 0, VK_WHOLE_SIZE};
            views[i] = bound.records->part_view(bound.part);
        } else {
            buffers[i] = {bound.buffer->handle(), 0, VK_WHOLE_SIZE};
            views[i] = binding.type == BindingType::texel_buffer ? bound.buffer->texels() : VK_NULL_HANDLE;
        }
        writes[i] = {};
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = binding.binding;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = descriptor_type(binding.type);
        writes[i].pBufferInfo = &buffers[i];
        writes[i].pTexelBufferView = &views[i];
    }
    vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
    return set;
}

void Kernel::Impl::run(const CommandQueue::Record& dispatch, std::span<const BoundBuffer> bindings,
                       std::span<const std::byte> push_constants, CommandQueue::Took took) {
    const auto record = [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline->handle());
        if (sets) {
            const VkDescriptorSet set = bound(bindings);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline->layout(), 0, 1, &set, 0, nullptr);
        }
        if (!push_constants.empty()) {
            vkCmdPushConstants(commands, pipeline->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               static_cast<std::uint32_t>(push_constants.size()), push_constants.data());
        }
        dispatch(commands);
    };
    // Drivers put off a part of making it until then.
    const std::shared_ptr<void> room = is_new ? need_kernel_room(device, name) : nullptr;
    device.impl().queue->record(name, record, std::move(took));
    is_new = false;
}

void Kernel::Impl::run_in_parts(const Groups& first, const Groups& groups, std::span<const BoundBuffer> bindings,
                                std::span<const std::byte> push_constants) {
    const std::uint64_t n_groups = std::uint64_t{groups[0]} * groups[1] * groups[2];
    for (std::uint64_t done = 0; done < n_groups;) {
        device.check_task();
        DispatchPart part = next_part(groups, done, pace->next(n_groups - done));
        std::transform(first.begin(), first.end(), part.first.begin(), part.first.begin(), std::plus<>());
        const auto dispatch = [&part](VkCommandBuffer commands) {
            vkCmdDispatchBase(commands, part.first[0], part.first[1], part.first[2], part.count[0], part.count[1],
                              part.count[2]);
        };
        if (device.collects_submissions()) {
            run(dispatch, bindings, push_constants,
                [held = pace, n = part.n_groups()](double milliseconds) { held->took(n, milliseconds); });
        } else {
            const auto start = std::chrono::steady_clock::now();
            run(dispatch, bindings, push_constants, {});
            pace->took(part.n_groups(), milliseconds_since(start));
        }
        done += part.n_groups();
    }
}

std::vector<BindingLayout> buffer_bindings(const BufferCounts& counts) {
    std::vector<BindingLayout> bindings;
    for (std::uint32_t binding = 0; binding < counts.uniform + counts.storage; ++binding) {
        bindings.push_back({binding, binding < counts.uniform ? BindingType::uniform_buffer : BindingType::storage_buffer});
    }
    return bindings;
}

Kernel::Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::vector<BindingLayout> layout,
               std::uint32_t push_constant_bytes, std::string name)
    : m_impl(std::make_unique<Impl>(device, std::move(layout), push_constant_bytes, std::move(name))) {
    m_impl->check_limits();
    m_impl->create_pipeline(spirv);
    if (!m_impl->layout.empty()) {
        m_impl->sets =
            std::make_shared<DescriptorSets>(device.handle(), m_impl->pipeline->set_layout(), m_impl->layout, m_impl->place);
    }
}

Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

void Kernel::dispatch_indirect(std::span<const BoundBuffer> bindings, std::span<const std::byte> push_constants,
                               const Buffer& size) const {
    Impl& impl = *m_impl;
    assert(push_constants.size() == impl.push_constant_bytes);
    impl.check_bindings(bindings);
    const std::lock_guard lock(impl.mutex);
    impl.device.check_task();
    impl.run([&size](VkCommandBuffer commands) { vkCmdDispatchIndirect(commands, size.handle(), 0); }, bindings, push_constants,
             {});
}

void Kernel::dispatch(std::span<const BoundBuffer> bindings, std::span<const std::byte> push_constants, std::uint32_t groups_x,
                      std::uint32_t groups_y, std::uint32_t groups_z) const {
    dispatch_from({0, 0, 0}, bindings, push_constants, {groups_x, groups_y, groups_z});
}

void Kernel::dispatch_from(const Groups& first, std::span<const BoundBuffer> bindings,
                           std::span<const std::byte> push_constants, const Groups& groups) const {
    Impl& impl = *m_impl;
    assert(push_constants.size() == impl.push_constant_bytes);
    if (groups[0] == 0 || groups[1] == 0 || groups[2] == 0) {
        return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        check_limit(std::size_t{first[axis]} + groups[axis], impl.device.limits().maxComputeWorkGroupCount[axis], impl.place,
                    "work groups in one direction");
    }
    impl.check_bindings(bindings);
    const std::lock_guard lock(impl.mutex);
    impl.run_in_parts(first, groups, bindings, push_constants);
}

} // namespace elvis
