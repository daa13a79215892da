#include <core/volume/element/element_records.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 32;
/** Elements of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t block = 65536;
/** Those of the record but for the number; then the curvature. */
constexpr std::uint32_t words_an_element = element_record_size;

struct Parameters {
    std::uint32_t first, n_elements;
};

} // namespace

std::vector<float> write_elements(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                  const SnippetInstance& instance, Precision precision, RecordBuffer& records) {
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
            curvatures.push_back(std::bit_cast<float>(from[words_an_element - 1]));
        }
        records.write_uints(first, words);
    }
    return curvatures;
}

} // namespace elvis
