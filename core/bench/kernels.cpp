#include <core/bench/kernels.hpp>

#include <core/bench/four_pictures.hpp>
#include <core/vulkan/device_choice.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

namespace elvis {

namespace {

/** Kernels that a device has been given, by name. */
class KernelRecord {
public:
    void add(const KernelCode& code) {
        const std::lock_guard lock(m_mutex);
        m_kernels.emplace(code.name, code);
    }
    /** Only after all is drawn. */
    const std::map<std::string, KernelCode>& kernels() const { return m_kernels; }

private:
    std::mutex m_mutex;
    std::map<std::string, KernelCode> m_kernels;
};

using Times = std::map<std::string, double>;

Times times_of(const Device& device) {
    Times times;
    for (const KernelTime& time : device.kernel_times()) {
        times[time.kernel] = time.milliseconds;
    }
    return times;
}

/** The inspected device if it draws, else the best that does. */
DeviceOptions drawing_options(const KernelInspector& inspector) {
    DeviceOptions options = DeviceOptions::from_environment();
    const DeviceSummary& inspected = inspector.summary();
    const std::vector<DeviceSummary> devices = list_devices();
    const bool draws = inspected.unusable_because.empty();
    if (draws) {
        options.wanted = std::to_string(inspected.index);
    } else {
        // $ELVIS_DEVICE may name the one that only compiles.
        const auto found =
            std::ranges::find_if(devices, [](const DeviceSummary& device) { return device.unusable_because.empty(); });
        options.wanted = found != devices.end() ? std::to_string(found->index) : "";
    }
    options.data_buffers = inspector.data_buffers();
    options.subgroup_size = inspector.subgroup_size();
    return options;
}

/** The kernels with the largest times that make up nine tenths of all. */
std::set<std::string> hottest(const Times& times) {
    std::vector<std::pair<double, std::string>> sorted;
    double all = 0;
    for (const auto& [kernel, milliseconds] : times) {
        sorted.emplace_back(milliseconds, kernel);
        all += milliseconds;
    }
    std::ranges::sort(sorted, std::greater{});
    std::set<std::string> hot;
    double so_far = 0;
    for (const auto& [milliseconds, kernel] : sorted) {
        if (so_far >= 0.9 * all) {
            break;
        }
        so_far += milliseconds;
        hot.insert(kernel);
    }
    return hot;
}

struct DrawnKernels {
    Times times;
    std::set<std::string> hot;
};

/** Each picture twice: kernels are ready the second time, which is what counts. */
DrawnKernels draw(const Device& device, Renderer& renderer, std::uint32_t size) {
    DrawnKernels drawn;
    for (const NamedFrame& picture : four_pictures(renderer, size)) {
        renderer.render(picture.request);
        const Times before = times_of(device);
        renderer.render(picture.request);
        Times of_picture;
        for (const auto& [kernel, milliseconds] : times_of(device)) {
            const auto earlier = before.find(kernel);
            of_picture[kernel] = milliseconds - (earlier != before.end() ? earlier->second : 0);
            drawn.times[kernel] += of_picture[kernel];
        }
        drawn.hot.merge(hottest(of_picture));
    }
    return drawn;
}

void inspect_volume(const KernelInspector& inspector, const RuntimeVolume& volume, const std::string& name, Precision precision,
                    std::uint32_t size, const std::function<void(const KernelRow&)>& report) {
    KernelRecord record;
    DrawnKernels drawn;
    {
        DeviceOptions options = drawing_options(inspector);
        options.on_kernel = [&record](const KernelCode& code) { record.add(code); };
        const Device device(options);
        Renderer renderer(device, volume, precision);
        drawn = draw(device, renderer, size);
    }
    double all = 0;
    std::vector<std::pair<double, const KernelCode*>> sorted;
    for (const auto& [kernel, code] : record.kernels()) {
        const double milliseconds = drawn.times[kernel];
        sorted.emplace_back(milliseconds, &code);
        all += milliseconds;
    }
    std::ranges::stable_sort(sorted, std::greater{}, [](const auto& kernel) { return kernel.first; });
    for (const auto& [milliseconds, code] : sorted) {
        report({.kernel = code->file,
                .shape = name,
                .precision = code->precision,
                .share = all > 0 ? milliseconds / all : 0,
                .is_hot = drawn.hot.count(code->name) != 0,
                .spirv_bytes = code->spirv.size() * sizeof(std::uint32_t),
                .statistics = inspector.inspect(*code)});
    }
}

RuntimeVolume bent_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& shape) {
    return generated_volume(registry, folder, "kernels-" + shape,
                            R"({"generator":1,"mesh":"waves","shape":")" + shape +
                                R"(","geometry_order":3,"field":"waves","elements":2,"order":5})");
}

} // namespace

void bench_kernels(const KernelInspector& inspector, const PluginRegistry& registry, const BenchFolder& folder,
                   const KernelsOptions& options, const std::function<void(const KernelRow&)>& report) {
    const auto inspect = [&](const RuntimeVolume& volume, const std::string& name) {
        for (const Precision precision : options.precisions) {
            inspect_volume(inspector, volume, name, precision, options.size, report);
        }
    };
    for (const std::string& file : options.volumes) {
        inspect(RuntimeVolume(registry.runtime_for(file), file), std::filesystem::path(file).stem().string());
    }
    if (options.volumes.empty()) {
        for (const std::string& shape : options.shapes) {
            inspect(bent_volume(registry, folder, shape), shape);
        }
    }
}

} // namespace elvis
