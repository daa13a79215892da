#include <core/conformance/device_sampler.hpp>

#include <core/base/error.hpp>
#include <core/conformance/check.hpp>

#include <span>

namespace elvis::conformance {

namespace {

/** As in the kernel. */
struct DevicePoint {
    double x, y, z;
    std::uint32_t element;
    std::uint32_t component;
};

const Device& need_float64(const Device& device) {
    if (!device.summary().has_float64) {
        throw Skipped("the device " + device.summary().name + " has no double precision, in which checks are made");
    }
    return device;
}

void replace_by_name(Snippet& snippet, const std::vector<SnippetText>& replacements) {
    for (SnippetText& source : snippet.sources) {
        for (const SnippetText& replacement : replacements) {
            if (source.name == replacement.name) {
                source.text = replacement.text;
            }
        }
    }
}

const RuntimeVolume& need_fields(const RuntimeVolume& volume) {
    if (volume.fields().empty()) {
        throw Skipped("the volume has no field");
    }
    return volume;
}

} // namespace

std::string text_of_bad_index(const Sample& sample) {
    return "index " + std::to_string(static_cast<std::int64_t>(sample.bad_index)) + " in line " +
           std::to_string(static_cast<int>(sample.bad_index_line)) + " of the snippet, of " +
           std::to_string(static_cast<std::int64_t>(sample.bad_index_limit)) + " entries";
}

DeviceSampler::DeviceSampler(const RuntimeVolume& volume, const std::string& device, Precision precision)
    : m_device(device), m_volume(need_fields(volume)), m_precision(precision),
      m_on_device(need_float64(m_device), volume, precision, nullptr) {}

void DeviceSampler::select(std::uint32_t field, std::uint32_t time_step, double offset) {
    m_kernels.clear();
    m_on_device.select(field, time_step, std::vector<double>(m_volume.fields()[field].n_components, offset));
}

const ComposedKernel& DeviceSampler::kernel(std::uint32_t element_class, const SampleOptions& options) const {
    auto& kernel = m_kernels[{element_class, options.with_hessians, options.is_debug_build}];
    if (!kernel) {
        KernelRequest request;
        request.name = "conformance class " + std::to_string(element_class);
        request.kernel = "conformance/conformance.comp";
        request.precision = m_precision;
        request.with_second_derivatives = options.with_hessians;
        request.is_debug_build = options.is_debug_build;
        m_on_device.add_field(request, element_class);
        for (SnippetInstance& instance : request.instances) {
            replace_by_name(instance.snippet, m_replacements);
        }
        request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(std::uint32_t);
        kernel = std::make_unique<ComposedKernel>(m_device, request);
    }
    return *kernel;
}

std::vector<Sample> DeviceSampler::sample(const std::vector<SamplePoint>& points, const SampleOptions& options) const {
    std::vector<Sample> samples(points.size());
    for (std::uint32_t c = 0; c < m_volume.classes().size(); ++c) {
        const ClassInfo& info = m_volume.classes()[c];
        std::vector<DevicePoint> inputs;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const SamplePoint& point = points[i];
            if (point.element >= info.first_element && point.element - info.first_element < info.n_elements) {
                inputs.push_back({point.xi[0], point.xi[1], point.xi[2],
                                  static_cast<std::uint32_t>(point.element - info.first_element), point.component});
                places.push_back(i);
            }
        }
        if (inputs.empty()) {
            continue;
        }
        const Buffer input(m_device, inputs.size() * sizeof(DevicePoint));
        const Buffer output(m_device, inputs.size() * sizeof(Sample));
        input.write_items(std::span<const DevicePoint>(inputs));
        const auto n = static_cast<std::uint32_t>(inputs.size());
        const std::array<const Buffer*, 2> bindings{&input, &output};
        kernel(c, options).dispatch(bindings, std::as_bytes(std::span(&n, 1)), (n + 7) / 8);
        const auto found = output.read_items<Sample>(inputs.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            samples[places[i]] = found[i];
        }
    }
    return samples;
}

} // namespace elvis::conformance
