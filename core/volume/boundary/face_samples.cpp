#include <core/volume/boundary/face_samples.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t face_group_size = 32;
/** Points of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t points_a_dispatch = 1u << 20;

struct FaceParameters {
    std::uint32_t first, n_faces, n_points;
};

} // namespace

void sample_faces(const Device& device, const DeviceVolume& data, std::uint32_t element_class, const RecordBuffer& faces,
                  const FaceFit& fit, const std::function<void(std::uint64_t first, std::span<const double> positions)>& take) {
    KernelRequest request;
    request.name = "face_samples of element class " + std::to_string(element_class);
    request.kernel = "boundary/face_samples.comp";
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.buffers = {{"core_faces", &faces}};
    request.bindings = buffer_bindings({.storage = 2});
    request.push_constant_bytes = sizeof(FaceParameters);
    const ComposedKernel kernel(device, request);

    const std::uint64_t number_bytes = real_bytes(data.precision());
    const std::uint64_t n_points = fit.n_points();
    const std::uint64_t block =
        std::min<std::uint64_t>(faces.n_records(), std::max<std::uint64_t>(1, points_a_dispatch / n_points));
    const Buffer output(device, 3 * block * n_points * number_bytes), input(device, fit.points().size() * number_bytes);
    write_reals(input, data.precision(), fit.points());
    const std::array<const Buffer*, 2> bindings = {&output, &input};
    for (std::uint64_t first = 0; first < faces.n_records(); first += block) {
        const std::uint64_t count = std::min(block, faces.n_records() - first);
        const FaceParameters parameters{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                                        static_cast<std::uint32_t>(n_points)};
        const auto n = static_cast<std::uint32_t>(count * n_points);
        kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (n + face_group_size - 1) / face_group_size);
        take(first, read_reals(output, data.precision(), std::size_t{3} * n));
    }
}

} // namespace elvis
