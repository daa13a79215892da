#include <core/probe/device_class.hpp>

#include <algorithm>
#include <array>

namespace elvis {
namespace {

// Numbers filled and uploaded at once.
constexpr std::uint64_t block_numbers = 1u << 22;
constexpr std::uint32_t group_size = 32;

} // namespace

DeviceClass::DeviceClass(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field,
                         std::uint32_t time_step)
    : m_device(&device), m_name("class " + std::to_string(element_class) + " " + volume.fields()[field].name) {
    m_instance.snippet = volume.snippet(element_class);
    m_instance.shape = volume.classes()[element_class].shape;
    m_instance.n_components = volume.fields()[field].n_components;
    m_instance.constants = volume.class_field(element_class, field).constants;

    // Neither offset nor origins: double precision has digits enough for both.
    const std::vector<double> offset(m_instance.n_components, 0.0);
    const std::vector<double> origins(3 * volume.n_elements(), 0.0);
    const bool has_local_origin = (m_instance.snippet.capabilities & ELVIS_SNIPPET_LOCAL_ORIGIN) != 0;
    for (std::uint32_t index = 0; index < volume.n_buffers(); ++index) {
        const BufferInfo info = volume.buffer(index, field);
        if (info.element_class != element_class && info.element_class != ELVIS_ALL_CLASSES)
            continue;
        const bool is_real = info.kind == ELVIS_BUFFER_REAL;
        m_buffers.push_back(std::make_unique<RecordBuffer>(device, is_real ? RecordKind::real : RecordKind::uint,
                                                           Precision::float64, info.n_records, info.record_size));
        m_instance.buffers.push_back({info.name, m_buffers.back().get()});
        const std::uint64_t block = std::max<std::uint64_t>(1, block_numbers / std::max(1u, info.record_size));
        for (std::uint64_t first = 0; first < info.n_records; first += block) {
            const std::uint64_t count = std::min(block, info.n_records - first);
            const elvis_fill_request request{sizeof(elvis_fill_request),
                                             index,
                                             field,
                                             time_step,
                                             first,
                                             count,
                                             offset.data(),
                                             has_local_origin ? origins.data() : nullptr};
            if (is_real) {
                std::vector<double> numbers(count * info.record_size);
                volume.fill_buffer(request, numbers.data());
                m_buffers.back()->write_reals(first, numbers);
            } else {
                std::vector<std::uint32_t> numbers(count * info.record_size);
                volume.fill_buffer(request, numbers.data());
                m_buffers.back()->write_uints(first, numbers);
            }
        }
    }
}

void DeviceClass::run(const std::string& kernel, std::span<const std::byte> parameters, const Buffer& input,
                      const Buffer& output, std::uint32_t n_items) const {
    std::vector<std::byte> constants(parameters.begin(), parameters.end());
    const auto tail = std::as_bytes(std::span(&n_items, 1));
    constants.insert(constants.end(), tail.begin(), tail.end());

    KernelRequest request;
    request.name = "probe " + m_name;
    request.kernel = kernel;
    request.precision = Precision::float64;
    request.instances = {m_instance};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = static_cast<std::uint32_t>(constants.size());
    const std::array<const Buffer*, 2> bindings{&input, &output};
    ComposedKernel(*m_device, request).dispatch(bindings, constants, (n_items + group_size - 1) / group_size);
}

} // namespace elvis
