#include <core/base/error.hpp>
#include <core/base/in_parts.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/volume/element/mapping_curvature.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace elvis {

namespace {

constexpr std::uint32_t element_group_size = 32;
/** Elements of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t element_block = 65536;
/** Of which a thread bounds the curvatures before it takes others. */
constexpr std::uint64_t elements_a_thread = 512;
/** Those of the record but for the number; then the curvature, and a box. */
constexpr std::uint32_t curvature_at = element_record_size - 1, box_at = element_record_size;
constexpr std::uint32_t words_an_element = box_at + 6;
/** Bounds that are estimated may be a little too narrow; more than this share of them loses what people see. */
constexpr float visible_share = 1e-3F;

struct ElementParameters {
    std::uint32_t first, n_elements;
};

/** Lower and upper corner of positions of an element, as bits of floats. */
using SeenBox = std::span<const std::uint32_t, 6>;

/** By how much an element was seen outside of its box, if that is more than may be. */
float beyond_box(std::span<const float, 6> said, std::span<const float, 3> origin, SeenBox seen) {
    float size = 0, beyond = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float lower = origin[axis] + std::bit_cast<float>(seen[axis]);
        const float upper = origin[axis] + std::bit_cast<float>(seen[axis + 3]);
        size = std::max(size, said[axis + 3] - said[axis]);
        beyond = std::max({beyond, said[axis] - lower, upper - said[axis + 3]});
        // Far from where they are counted from, positions are rounded.
        size = std::max(size, std::abs(origin[axis]) * 1e-3F);
    }
    return beyond > visible_share * size ? beyond : 0;
}

void check_box(const RuntimeVolume& volume, std::uint64_t element, std::span<const float, 6> said,
               std::span<const float, 3> origin, std::span<const float, 3> world_origin, SeenBox seen) {
    const float beyond = beyond_box(said, origin, seen);
    if (beyond == 0) {
        return;
    }
    const bool is_world = beyond_box(said, world_origin, seen) == 0;
    throw Error(volume.path(),
                "element " + std::to_string(element) + " reaches " + std::to_string(beyond) +
                    " beyond the bounds that the plugin tells of it (get_bounds): parts of it would be missing "
                    "in pictures; " +
                    (is_world ? "the difference is the element's origin: with ELVIS_SNIPPET_LOCAL_ORIGIN, subtract "
                                "elvis_fill_request.origins from positions in fill_buffer"
                              : "`elvis check-plugin` tells more"));
}

bool is_proven(float curvature) { return curvature >= 0 && curvature < unknown_curvature; }

/** What shaders/element/linearize.comp expects. */
std::vector<float> proven_curvatures(const Device& device, const RuntimeVolume& volume, const ClassInfo& info,
                                     std::vector<ElementBends>& bends) {
    if (info.is_affine) {
        return std::vector<float>(info.n_elements, 0.0F);
    }
    if (!volume.has_evaluation() || !CurvatureBounder::can_bound(info)) {
        return std::vector<float>(info.n_elements, -1.0F);
    }
    const CurvatureBounder bounder(info.shape, info.geometry_order);
    const ElementMapping mapping = [&](std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                                       std::span<double> jacobians) {
        volume.evaluate_mapping(element, xi, positions, jacobians);
    };
    std::vector<float> curvatures(info.n_elements);
    bends.resize(info.n_elements);
    in_parts(
        device.background(), info.n_elements, elements_a_thread,
        [&](std::uint64_t first, std::uint64_t count) {
            bounder(mapping, info.first_element + first, std::span(curvatures).subspan(first, count),
                    std::span(bends).subspan(first, count));
        },
        [&] { device.check_task(); });
    if (std::ranges::all_of(curvatures, [](float curvature) { return curvature <= followed_curvature; })) {
        bends = {};
    }
    return curvatures;
}

KernelRequest linearize_request(std::uint32_t element_class, const SnippetInstance& instance, Precision precision,
                                std::span<const float> proven) {
    const bool is_measured = !std::ranges::all_of(proven, is_proven);
    KernelRequest request;
    request.name = "linearize of element class " + std::to_string(element_class);
    request.kernel = "element/linearize.comp";
    request.watches_loops = true;
    request.precision = precision;
    request.instances = {instance};
    request.defines = {{"CORE_IS_MEASURED", is_measured ? "1" : "0"}};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(ElementParameters);
    return request;
}

} // namespace

ElementWriter::ElementWriter(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                             const SnippetInstance& instance, Precision precision)
    : m_device(device), m_volume(volume), m_info(volume.classes()[element_class]),
      m_proven(proven_curvatures(device, volume, m_info, m_curvatures.bends)),
      m_kernel(device, linearize_request(element_class, instance, precision, m_proven)),
      m_output(device, n_at(0) * words_an_element * sizeof(std::uint32_t)), m_input(device, n_at(0) * sizeof(float)) {}

/** Elements of one dispatch from `first` on. */
std::uint64_t ElementWriter::n_at(std::uint64_t first) const { return std::min(element_block, m_info.n_elements - first); }

void ElementWriter::dispatch(std::uint64_t first, KernelResults& results) const {
    const auto count = static_cast<std::uint32_t>(n_at(first));
    const ElementParameters parameters{static_cast<std::uint32_t>(first), count};
    m_input.write_items(std::span<const float>(m_proven).subspan(first, count));
    const std::array<const Buffer*, 2> bindings = {&m_output, &m_input};
    results.dispatch(m_kernel, bindings, std::as_bytes(std::span(&parameters, 1)),
                     (count + element_group_size - 1) / element_group_size, m_output, std::size_t{count} * words_an_element);
}

void ElementWriter::start(KernelResults& results) {
    m_started = results.size();
    dispatch(0, results);
}

ElementCurvatures ElementWriter::write(const ElementBoxes& said, RecordBuffer& records, const KernelResults& started) {
    m_curvatures.numbers.reserve(m_info.n_elements);
    m_curvatures.are_proven.reserve(m_info.n_elements);
    std::vector<std::int64_t> numbers;
    std::vector<std::uint32_t> words;
    for (std::uint64_t first = 0; first < m_info.n_elements; first += element_block) {
        const auto count = static_cast<std::uint32_t>(n_at(first));
        KernelResults results;
        if (first > 0) {
            dispatch(first, results);
            results.read();
        }
        const std::vector<std::uint32_t>& computed = first > 0 ? results[0] : started[m_started];
        numbers.resize(count);
        m_volume.element_numbers(m_info.first_element + first, count, numbers);
        words.clear();
        for (std::size_t element = 0; element < count; ++element) {
            words.push_back(static_cast<std::uint32_t>(numbers[element]));
            const auto from = computed.begin() + static_cast<std::ptrdiff_t>(element * words_an_element);
            words.insert(words.end(), from, from + element_record_size - 1);
            m_curvatures.numbers.push_back(std::bit_cast<float>(from[curvature_at]));
            m_curvatures.are_proven.push_back(is_proven(m_proven[first + element]));
            check_box(m_volume, m_info.first_element + first + element,
                      std::span(said.boxes).subspan(6 * (first + element)).first<6>(),
                      std::span(said.origins).subspan(3 * (first + element)).first<3>(), said.world_origin,
                      std::span(computed).subspan(element * words_an_element + box_at).first<6>());
        }
        records.write_uints(first, words);
    }
    return std::move(m_curvatures);
}

} // namespace elvis
