#include <core/base/error.hpp>
#include <core/volume/element/element_records.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 32;
/** Elements of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t block = 65536;
/** Those of the record but for the number; then the curvature, and a box. */
constexpr std::uint32_t curvature_at = element_record_size - 1, box_at = element_record_size;
constexpr std::uint32_t words_an_element = box_at + 6;
/** Bounds that are estimated may be a little too narrow; more than this share of them loses what people see. */
constexpr float visible_share = 1e-3F;

struct Parameters {
    std::uint32_t first, n_elements;
};

/** `seen`: lower and upper corner of positions of an element, as bits of floats. */
void check_box(const RuntimeVolume& volume, std::uint64_t element, std::span<const float, 6> said,
               std::span<const float, 3> origin, std::span<const std::uint32_t, 6> seen) {
    float size = 0, beyond = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float lower = origin[axis] + std::bit_cast<float>(seen[axis]);
        const float upper = origin[axis] + std::bit_cast<float>(seen[axis + 3]);
        size = std::max(size, said[axis + 3] - said[axis]);
        beyond = std::max({beyond, said[axis] - lower, upper - said[axis + 3]});
        // Far from where they are counted from, positions are rounded.
        size = std::max(size, std::abs(origin[axis]) * 1e-3F);
    }
    if (beyond > visible_share * size) {
        throw Error(volume.path(),
                    "element " + std::to_string(element) + " reaches " + std::to_string(beyond) +
                        " beyond the bounds that the plugin tells of it (get_bounds): parts of it would be missing "
                        "in pictures; `elvis check-plugin` tells more");
    }
}

} // namespace

std::vector<float> write_elements(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                  const SnippetInstance& instance, Precision precision, const ElementBoxes& said,
                                  RecordBuffer& records) {
    const ClassInfo& info = volume.classes()[element_class];
    KernelRequest request;
    request.name = "linearize of element class " + std::to_string(element_class);
    request.kernel = "element/linearize.comp";
    request.watches_loops = true;
    request.precision = precision;
    request.instances = {instance};
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(Parameters);
    const ComposedKernel kernel(device, request);
    const Buffer output(device, std::min(block, info.n_elements) * words_an_element * sizeof(std::uint32_t));
    const std::array<const Buffer*, 1> bindings = {&output};

    std::vector<float> curvatures;
    std::vector<std::int64_t> numbers;
    std::vector<std::uint32_t> words;
    for (std::uint64_t first = 0; first < info.n_elements; first += block) {
        const auto count = static_cast<std::uint32_t>(std::min(block, info.n_elements - first));
        const Parameters parameters{static_cast<std::uint32_t>(first), count};
        kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (count + group_size - 1) / group_size);
        const auto computed = output.read_items<std::uint32_t>(std::size_t{count} * words_an_element);
        numbers.resize(count);
        volume.element_numbers(info.first_element + first, count, numbers);
        words.clear();
        for (std::size_t element = 0; element < count; ++element) {
            words.push_back(static_cast<std::uint32_t>(numbers[element]));
            const auto from = computed.begin() + static_cast<std::ptrdiff_t>(element * words_an_element);
            words.insert(words.end(), from, from + element_record_size - 1);
            curvatures.push_back(std::bit_cast<float>(from[curvature_at]));
            check_box(volume, info.first_element + first + element,
                      std::span(said.boxes).subspan(6 * (first + element)).first<6>(),
                      std::span(said.origins).subspan(3 * (first + element)).first<3>(),
                      std::span(computed).subspan(element * words_an_element + box_at).first<6>());
        }
        records.write_uints(first, words);
    }
    return curvatures;
}

} // namespace elvis
