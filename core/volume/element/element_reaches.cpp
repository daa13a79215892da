#include <core/shader/kernel_results.hpp>
#include <core/volume/element/element_reaches.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace elvis {

namespace {

/** Elements of one dispatch, a work group each; and of one write. */
constexpr std::size_t reach_block = 16384;
/** shaders/cut_surface/reach.glsl: six numbers of half precision, of which nothing is known. */
constexpr std::uint32_t reach_record_size = 3;
constexpr std::uint32_t reach_unknown = 0x7b537b53;

KernelRequest reach_request(const DeviceVolume& data, std::uint32_t element_class) {
    KernelRequest request;
    request.name = "element_reaches of element class " + std::to_string(element_class);
    request.kernel = "cut_surface/element_reaches.comp";
    request.watches_loops = true;
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.buffers = {data.elements(element_class)};
    request.bindings = buffer_bindings({.storage = 2});
    return request;
}

/** shaders/cut_surface/reach.glsl */
constexpr float least_bent = 0.5F;

} // namespace

bool ElementReaches::has_bent(std::span<const float> curvatures) {
    return std::ranges::any_of(curvatures, [](float curvature) { return curvature > least_bent; });
}

ElementReaches::ElementReaches(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                               std::uint32_t element_class)
    : m_device(device), m_data(data), m_class(element_class), m_n_elements(volume.classes()[element_class].n_elements),
      m_records(device, RecordKind::uint, data.precision(), m_n_elements, reach_record_size),
      m_wanted(device, (m_n_elements + 1) * sizeof(std::uint32_t)), m_geometry_version(data.geometry_version()) {
    clear();
}

void ElementReaches::clear() {
    m_wanted.fill(0);
    m_is_known.assign(m_n_elements, false);
    const std::vector<std::uint32_t> words(reach_record_size * std::min<std::uint64_t>(reach_block, m_n_elements),
                                           reach_unknown);
    for (std::uint64_t first = 0; first < m_n_elements; first += reach_block) {
        const std::uint64_t count = std::min<std::uint64_t>(reach_block, m_n_elements - first);
        m_records.write_uints(first, std::span(words).first(reach_record_size * count));
    }
}

void ElementReaches::begin() {
    if (m_geometry_version != m_data.geometry_version()) {
        clear();
        m_geometry_version = m_data.geometry_version();
    }
}

void ElementReaches::provide(const Buffer::Read& also) {
    const std::vector<std::uint32_t> is_wanted = m_wanted.read_if_any(m_n_elements, also);
    if (is_wanted[0] == 0) {
        return;
    }
    std::vector<std::uint32_t> elements;
    for (std::uint32_t element = 0; element < m_n_elements; ++element) {
        if (is_wanted[1 + element] != 0 && !m_is_known[element]) {
            elements.push_back(element);
            m_is_known[element] = true;
        }
    }
    bound(elements);
    const std::uint32_t none = 0;
    m_wanted.write_items(std::span(&none, 1));
}

void ElementReaches::bound(std::span<const std::uint32_t> elements) {
    if (!m_kernel) {
        m_kernel.emplace(m_device, reach_request(m_data, m_class));
    }
    const std::size_t at_once = std::min(elements.size(), reach_block);
    const Buffer input(m_device, at_once * sizeof(std::uint32_t));
    const Buffer output(m_device, at_once * reach_record_size * sizeof(std::uint32_t));
    const std::array<const Buffer*, 2> bindings = {&input, &output};
    for (std::size_t first = 0; first < elements.size(); first += at_once) {
        const std::span<const std::uint32_t> wanted = elements.subspan(first, std::min(at_once, elements.size() - first));
        input.write_items(wanted);
        KernelResults results;
        results.dispatch(*m_kernel, bindings, {}, static_cast<std::uint32_t>(wanted.size()), output,
                         wanted.size() * reach_record_size);
        results.read();
        const std::vector<std::uint32_t>& words = results[0];
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            m_records.write_uints(wanted[i], std::span(words).subspan(reach_record_size * i, reach_record_size));
        }
    }
}

} // namespace elvis
