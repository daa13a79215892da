#include <core/render/device/in_batches.hpp>
#include <core/render/field/point_value_pass.hpp>

#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t point_value_group_size = 64;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t point_value_pixels_a_dispatch = 1u << 18;

struct PointValueParameters {
    std::uint32_t first, n_pixels;
    std::uint32_t first_component, end_component;
};

} // namespace

PointValuePass::PointValuePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_counts(device, sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "point_values of element class " + std::to_string(index);
        request.kernel = "field/point_values.comp";
        request.precision = data.precision();
        data.add_field(request, index);
        request.defines = {{"CORE_GROUP_SIZE", std::to_string(point_value_group_size)},
                           {"CORE_CLASS", std::to_string(index) + "u"}};
        request.bindings = buffer_bindings({.storage = 4});
        request.push_constant_bytes = sizeof(PointValueParameters);
        m_kernels.push_back(std::make_unique<ComposedKernel>(device, request));
    }
}

void PointValuePass::draw(const ShownComponent& component, const LayerTarget& target, const Buffer& samples,
                          FrameCounts& counts) {
    m_counts.fill(0);
    const auto n_pixels = static_cast<std::uint32_t>(target.layer.n_pixels());
    const std::array<const Buffer*, 4> bindings = {&samples, &target.layer.marks, target.places, &m_counts};
    for (const std::unique_ptr<ComposedKernel>& kernel : m_kernels) {
        in_batches(n_pixels, items_a_dispatch(m_device, point_value_pixels_a_dispatch, point_value_group_size),
                   [&](std::uint32_t first, std::uint32_t count) {
                       const PointValueParameters parameters{first, n_pixels, component.first(), component.end()};
                       kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                        divided_up(count, point_value_group_size));
                   });
    }
    counts.field_evaluations += m_counts.read_items<std::uint32_t>(1)[0];
}

} // namespace elvis
