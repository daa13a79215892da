#include <core/volume/boundary/face_samples.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 32;
/** Points of one dispatch: bounds its time and the memory for its results. */
constexpr std::uint64_t points_a_dispatch = 1u << 20;

struct Parameters {
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
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(Parameters);
    const ComposedKernel kernel(device, request);

    const bool is_double = data.precision() == Precision::float64;
    const std::uint64_t real_bytes = is_double ? sizeof(double) : sizeof(float);
    const std::uint64_t n_points = fit.n_points();
    const std::uint64_t block =
        std::min<std::uint64_t>(faces.n_records(), std::max<std::uint64_t>(1, points_a_dispatch / n_points));
    const Buffer output(device, 3 * block * n_points * real_bytes), input(device, fit.points().size() * real_bytes);
    if (is_double) {
        input.write_items(fit.points());
    } else {
        const std::vector<float> rounded(fit.points().begin(), fit.points().end());
        input.write_items(std::span<const float>(rounded));
    }
    const std::array<const Buffer*, 2> bindings = {&output, &input};
    std::vector<double> positions;
    for (std::uint64_t first = 0; first < faces.n_records(); first += block) {
        const std::uint64_t count = std::min(block, faces.n_records() - first);
        const Parameters parameters{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                                    static_cast<std::uint32_t>(n_points)};
        const auto n = static_cast<std::uint32_t>(count * n_points);
        kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (n + group_size - 1) / group_size);
        if (is_double) {
            positions = output.read_items<double>(std::size_t{3} * n);
        } else {
            const std::vector<float> read = output.read_items<float>(std::size_t{3} * n);
            positions.assign(read.begin(), read.end());
        }
        take(first, positions);
    }
}

} // namespace elvis
