#include <core/vulkan/kernel/kernel_inspector.hpp>

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/compute_device.hpp>
#include <core/vulkan/device_choice.hpp>
#include <core/vulkan/device_summary.hpp>
#include <core/vulkan/instance.hpp>
#include <core/vulkan/subgroup_choice.hpp>

#include <array>
#include <chrono>
#include <cstring>
#include <span>
#include <vector>

namespace elvis {

namespace {

constexpr const char* statistics_extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

/** How drivers call what is asked for: RADV, ANV, NVIDIA. */
struct Statistic {
    const char* name;
    std::optional<std::uint64_t> KernelStatistics::*value;
};
constexpr std::array<Statistic, 12> known_statistics{Statistic{"VGPRs", &KernelStatistics::registers},
                                                     Statistic{"Spilled VGPRs", &KernelStatistics::spills},
                                                     Statistic{"Scratch size", &KernelStatistics::scratch_bytes},
                                                     Statistic{"Subgroups per SIMD", &KernelStatistics::waves},
                                                     Statistic{"Code size", &KernelStatistics::code_bytes},
                                                     Statistic{"Spill count", &KernelStatistics::spills},
                                                     Statistic{"Scratch Memory Size", &KernelStatistics::scratch_bytes},
                                                     Statistic{"Max live registers", &KernelStatistics::registers},
                                                     Statistic{"Register Count", &KernelStatistics::registers},
                                                     Statistic{"Local Memory Size", &KernelStatistics::scratch_bytes},
                                                     Statistic{"Stack Size", &KernelStatistics::scratch_bytes},
                                                     Statistic{"Binary Size", &KernelStatistics::code_bytes}};

/**
 * Negative and fractional values are none of what is asked for. None is as large as 2^32: what is has bits that mean nothing,
 * as 2^36 in NVIDIA's "Local Memory Size" (580.159).
 */
std::uint64_t whole(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
        return statistic.value.u64 & UINT32_MAX;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
        return static_cast<std::uint64_t>(std::max<std::int64_t>(statistic.value.i64, 0));
    default:
        return 0;
    }
}

} // namespace

struct KernelInspector::Impl {
    Instance instance{false};
    DeviceSummary summary;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    SubgroupChoice subgroup;
    bool tells = false;

    explicit Impl(const std::string& wanted)
        : summary(choose_among(instance.summaries(), wanted, DeviceUse::compiling)),
          physical(instance.physical_devices().at(summary.index)), subgroup(choose_subgroup(physical)),
          tells(has_extension(physical, statistics_extension)) {
        create_device();
    }
    ~Impl() { vkDestroyDevice(device, nullptr); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::string place() const { return "device '" + summary.name + "'"; }
    void create_device();
    template <class Function> Function function(const char* name) const {
        return reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
    }
    void read_statistics(VkPipeline pipeline, KernelStatistics& statistics) const;
};

void KernelInspector::Impl::create_device() {
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executable{};
    executable.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    executable.pipelineExecutableInfo = VK_TRUE;
    ComputeDeviceOptions options;
    options.chooses_subgroup_size = subgroup.required != 0;
    if (tells) {
        options.extensions = std::span(&statistics_extension, 1);
        options.features = &executable;
    }
    device = create_compute_device(physical, options, place());
}

void KernelInspector::Impl::read_statistics(VkPipeline pipeline, KernelStatistics& statistics) const {
    const auto properties_of = function<PFN_vkGetPipelineExecutablePropertiesKHR>("vkGetPipelineExecutablePropertiesKHR");
    const auto statistics_of = function<PFN_vkGetPipelineExecutableStatisticsKHR>("vkGetPipelineExecutableStatisticsKHR");
    VkPipelineInfoKHR pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
    pipeline_info.pipeline = pipeline;
    // A compute pipeline is one executable, or several variants of it, of which the first is the widest.
    std::uint32_t n_executables = 1;
    VkPipelineExecutablePropertiesKHR executable{};
    executable.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    const VkResult asked = properties_of(device, &pipeline_info, &n_executables, &executable);
    check_vulkan(asked == VK_INCOMPLETE ? VK_SUCCESS : asked, place(), "asking for statistics");
    if (n_executables == 0) {
        return;
    }
    statistics.subgroup_size = executable.subgroupSize;
    VkPipelineExecutableInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
    info.pipeline = pipeline;
    std::uint32_t n_statistics = 0;
    check_vulkan(statistics_of(device, &info, &n_statistics, nullptr), place(), "asking for statistics");
    VkPipelineExecutableStatisticKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    std::vector<VkPipelineExecutableStatisticKHR> told(n_statistics, empty);
    check_vulkan(statistics_of(device, &info, &n_statistics, told.data()), place(), "asking for statistics");
    for (const VkPipelineExecutableStatisticKHR& statistic : told) {
        for (const Statistic& known : known_statistics) {
            if (std::strcmp(known.name, statistic.name) == 0) {
                statistics.*known.value = whole(statistic);
            }
        }
    }
}

KernelInspector::KernelInspector(const std::string& wanted) : m_impl(std::make_unique<Impl>(wanted)) {}
KernelInspector::~KernelInspector() = default;

const DeviceSummary& KernelInspector::summary() const { return m_impl->summary; }
DataBuffers KernelInspector::data_buffers() const {
    return m_impl->summary.type == "cpu" ? DataBuffers::texel : DataBuffers::storage;
}
std::uint32_t KernelInspector::subgroup_size() const { return m_impl->subgroup.size; }
bool KernelInspector::tells() const { return m_impl->tells; }

KernelStatistics KernelInspector::inspect(const KernelCode& code) const {
    KernelStatistics statistics;
    statistics.subgroup_size = m_impl->subgroup.size;
    KernelPipeline::Options options;
    options.flags = m_impl->tells ? VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR : 0;
    options.subgroup_size = m_impl->subgroup.required;
    const auto start = std::chrono::steady_clock::now();
    const KernelPipeline pipeline(m_impl->device, code.spirv, code.layout, code.push_constant_bytes, options,
                                  "kernel '" + code.name + "' on " + m_impl->place());
    statistics.milliseconds = milliseconds_since(start);
    if (m_impl->tells) {
        m_impl->read_statistics(pipeline.handle(), statistics);
    }
    return statistics;
}

} // namespace elvis
