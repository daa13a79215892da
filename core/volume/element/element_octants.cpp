#include <core/hierarchy/hierarchy.hpp>
#include <core/shader/kernel_results.hpp>
#include <core/volume/element/element_octants.hpp>
#include <core/volume/isosurface/octants_ahead.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace elvis {

namespace {

/** Octants of one dispatch: bounds time and memory. */
constexpr std::size_t octant_block = 65536;
constexpr std::uint32_t octant_group_size = 32;
/** Halvings of an element: what is still bent then is looked at all the same, and may stay undecided. */
constexpr std::uint32_t most_octant_levels = 5;
/** shaders/cut_surface/open_points.comp */
constexpr std::uint32_t no_octants = 0xffffffffu, no_room = 0xfffffffdu;

std::span<const std::uint32_t> record_of(std::span<const std::uint32_t> words, std::size_t octant) {
    return words.subspan(octant * octant_words, octant_words);
}

bool is_linear(std::span<const std::uint32_t> record) { return std::bit_cast<float>(record[octant_scale]) > 0; }

KernelRequest octant_request(const DeviceVolume& data, std::uint32_t element_class) {
    KernelRequest request;
    request.name = "element_octants of element class " + std::to_string(element_class);
    request.kernel = "cut_surface/element_octants.comp";
    request.watches_loops = true;
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.buffers = data.curvature_records(element_class).buffers();
    request.defines = {{"CORE_GROUP_SIZE", std::to_string(octant_group_size)}};
    request.bindings = buffer_bindings({.storage = 3});
    request.push_constant_bytes = sizeof(std::uint32_t);
    return request;
}

} // namespace

ElementOctants::ElementOctants(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                               std::uint32_t element_class)
    : m_device(device), m_volume(volume), m_data(data), m_info(volume.classes()[element_class]),
      m_octants(device, RecordKind::uint, data.precision(), most_octants, octant_size),
      m_nodes(device, RecordKind::uint, data.precision(), 2 * most_octants, node_size),
      m_roots(device, m_info.n_elements * sizeof(std::uint32_t)),
      m_asked(device, (m_info.n_elements + 1) * sizeof(std::uint32_t)), m_kernel(device, octant_request(data, element_class)),
      m_geometry_version(data.geometry_version()) {
    clear();
}

void ElementOctants::clear() {
    m_roots.fill(no_octants);
    m_n_octants = m_n_nodes = 0;
    m_is_full = false;
}

void ElementOctants::begin() {
    if (m_is_full || m_geometry_version != m_data.geometry_version()) {
        clear();
        m_geometry_version = m_data.geometry_version();
    }
    const std::uint32_t none = 0;
    m_asked.write_items(std::span(&none, 1));
}

bool ElementOctants::provide() {
    const std::vector<std::uint32_t> asked = m_asked.read_if_any(m_info.n_elements);
    if (asked[0] == 0) {
        return false;
    }
    std::vector<std::uint32_t> elements(asked.begin() + 1, asked.begin() + 1 + asked[0]);
    // Kernels ask in any order; pictures are to be the same each time.
    std::sort(elements.begin(), elements.end());
    const std::vector<std::uint32_t> words = divide(elements);
    std::vector<std::size_t> order(words.size() / octant_words);
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return record_of(words, a)[octant_element] < record_of(words, b)[octant_element];
    });
    std::vector<std::uint32_t> of_element;
    std::size_t at = 0;
    for (const std::uint32_t element : elements) {
        of_element.clear();
        for (; at < order.size() && record_of(words, order[at])[octant_element] == element; ++at) {
            const std::span<const std::uint32_t> record = record_of(words, order[at]);
            of_element.insert(of_element.end(), record.begin(), record.end());
        }
        add_element(element, of_element);
    }
    const std::uint32_t none = 0;
    m_asked.write_items(std::span(&none, 1));
    return true;
}

/** The octants of elements, as the kernel gives them. Level by level, as long as there is room for more. */
std::vector<std::uint32_t> ElementOctants::divide(std::span<const std::uint32_t> elements) const {
    OctantsAhead ahead(m_device, m_info.shape, [this](std::span<const std::uint32_t> asked) { return evaluate(asked); });
    std::vector<std::uint32_t> done, wanted;
    for (const std::uint32_t element : elements) {
        add_octants(wanted, element, 0, m_info.shape);
    }
    for (std::uint32_t level = 1; !wanted.empty(); ++level) {
        const std::vector<std::uint32_t> words = ahead(wanted);
        const std::size_t n_octants = words.size() / octant_words;
        std::size_t n_bent = 0;
        for (std::size_t i = 0; i < n_octants; ++i) {
            n_bent += is_linear(record_of(words, i)) ? 0 : 1;
        }
        const std::size_t n_divided = done.size() / octant_words + n_octants + 7 * n_bent;
        const bool is_last = level >= most_octant_levels || m_n_octants + n_divided > most_octants;
        wanted.clear();
        for (std::size_t i = 0; i < n_octants; ++i) {
            const std::span<const std::uint32_t> record = record_of(words, i);
            if (is_last || is_linear(record)) {
                done.insert(done.end(), record.begin(), record.end());
            } else {
                add_octants(wanted, record[octant_element], record[octant_code], m_info.shape);
            }
        }
    }
    return done;
}

std::vector<std::uint32_t> ElementOctants::evaluate(std::span<const std::uint32_t> elements_and_codes) const {
    const std::size_t n_octants = elements_and_codes.size() / 2, at_once = std::min(n_octants, octant_block);
    const Buffer input(m_device, at_once * 2 * sizeof(std::uint32_t));
    const Buffer output(m_device, at_once * octant_words * sizeof(std::uint32_t));
    const Buffer centre(m_device, sizeof(Vector3));
    write_reals(centre, m_data.precision(), m_data.centre());
    const std::array<const Buffer*, 3> bindings = {&input, &output, &centre};
    std::vector<std::uint32_t> words;
    words.reserve(n_octants * octant_words);
    for (std::size_t first = 0; first < n_octants; first += at_once) {
        const auto count = static_cast<std::uint32_t>(std::min(at_once, n_octants - first));
        input.write_items(elements_and_codes.subspan(2 * first, 2 * std::size_t{count}));
        KernelResults results;
        results.dispatch(m_kernel, bindings, std::as_bytes(std::span(&count, 1)),
                         (count + octant_group_size - 1) / octant_group_size, output, std::size_t{count} * octant_words);
        results.read();
        words.insert(words.end(), results[0].begin(), results[0].end());
    }
    return words;
}

/** `words`: of its octants. */
void ElementOctants::add_element(std::uint32_t element, std::span<const std::uint32_t> words) {
    const std::size_t n_octants = words.size() / octant_words;
    if (m_n_octants + n_octants > most_octants) {
        m_is_full = true;
        m_roots.write_items(std::span(&no_room, 1), element);
        return;
    }
    const Vector3& centre = m_data.centre();
    std::array<double, 6> whole{};
    m_volume.bounds(m_info.first_element + element, 1, whole);
    std::vector<double> boxes;
    std::vector<std::uint32_t> records;
    for (std::size_t i = 0; i < n_octants; ++i) {
        const std::span<const std::uint32_t> record = record_of(words, i);
        records.insert(records.end(), record.begin(), record.begin() + octant_size);
        std::array<double, 6> box = whole;
        for (std::size_t k = 0; k < 3; ++k) {
            const double least = centre[k] + double{std::bit_cast<float>(record[octant_box + k])};
            const double most = centre[k] + double{std::bit_cast<float>(record[octant_box + 3 + k])};
            if (std::isfinite(most - least)) {
                box[k] = std::clamp(least, whole[k], whole[3 + k]);
                box[3 + k] = std::clamp(most, box[k], whole[3 + k]);
            }
        }
        boxes.insert(boxes.end(), box.begin(), box.end());
    }
    const Hierarchy hierarchy(boxes, centre);
    std::vector<std::uint32_t> nodes = node_words(hierarchy.nodes());
    constexpr std::size_t child_word = 3;
    for (std::size_t i = 0; i < hierarchy.nodes().size(); ++i) {
        nodes[node_size * i + child_word] +=
            static_cast<std::uint32_t>(hierarchy.nodes()[i].is_leaf() ? m_n_octants : m_n_nodes);
    }
    m_octants.write_uints(m_n_octants, records);
    m_nodes.write_uints(m_n_nodes, nodes);
    const auto root = static_cast<std::uint32_t>(m_n_nodes);
    m_roots.write_items(std::span(&root, 1), element);
    m_n_octants += n_octants;
    m_n_nodes += hierarchy.nodes().size();
}

std::vector<FetchBuffer> ElementOctants::buffers() const {
    return {{"core_octants", &m_octants}, {"core_octant_nodes", &m_nodes}};
}

} // namespace elvis
