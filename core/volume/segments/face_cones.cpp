#include <core/shader/kernel_results.hpp>
#include <core/volume/segments/face_cones.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace elvis {

namespace {

constexpr std::uint32_t cone_group_size = 32, words_a_cone = 8;
/** Elements of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t cone_block = 65536;

struct ConeParameters {
    std::uint32_t first, n_elements;
};

} // namespace

std::unique_ptr<RecordBuffer> measure_face_cones(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                                 std::uint32_t element_class) {
    const std::uint64_t n_elements = volume.classes()[element_class].n_elements;
    KernelRequest request;
    request.name = "face_cones of element class " + std::to_string(element_class);
    request.kernel = "segments/face_cones.comp";
    request.watches_loops = true;
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(ConeParameters);
    const ComposedKernel kernel(device, request);
    const Buffer output(device, std::min(cone_block, n_elements) * words_a_cone * sizeof(std::uint32_t));
    const std::array<const Buffer*, 1> bindings = {&output};
    auto cones = std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), n_elements, words_a_cone);
    for (std::uint64_t first = 0; first < n_elements; first += cone_block) {
        const auto count = static_cast<std::uint32_t>(std::min(cone_block, n_elements - first));
        const ConeParameters parameters{static_cast<std::uint32_t>(first), count};
        KernelResults results;
        results.dispatch(kernel, bindings, std::as_bytes(std::span(&parameters, 1)),
                         (count + cone_group_size - 1) / cone_group_size, output, std::size_t{count} * words_a_cone);
        results.read();
        cones->write_uints(first, results[0]);
    }
    return cones;
}

} // namespace elvis
