#include <core/render/field/point_value_pass.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 64;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t pixels_a_dispatch = 1u << 18;

struct Parameters {
    std::uint32_t first, n_pixels;
    std::uint32_t first_component, end_component;
};

} // namespace

PointValuePass::PointValuePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_counts(device, sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        m_kernels.emplace_back();
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "point_values of element class " + std::to_string(index);
        request.kernel = "field/point_values.comp";
        request.precision = data.precision();
        data.add_field(request, index);
        request.defines = {{"CORE_GROUP_SIZE", std::to_string(group_size)}, {"CORE_CLASS", std::to_string(index) + "u"}};
        for (std::uint32_t binding = 0; binding <= 3; ++binding) {
            request.bindings.push_back({binding, BindingType::storage_buffer});
        }
        request.push_constant_bytes = sizeof(Parameters);
        m_kernels.back() = std::make_unique<ComposedKernel>(device, request);
    }
}

void PointValuePass::draw(const ShownComponent& component, const LayerTarget& target, FrameCounts& counts) {
    m_counts.fill(0);
    const auto n_pixels = static_cast<std::uint32_t>(target.layer.n_pixels());
    const std::array<const Buffer*, 4> bindings = {&target.layer.samples, &target.layer.marks, target.places, &m_counts};
    for (std::uint32_t index = 0; index < m_kernels.size(); ++index) {
        for (std::uint32_t first = 0; m_kernels[index] && first < n_pixels; first += pixels_a_dispatch) {
            const Parameters parameters{first, n_pixels, component.first(), component.end()};
            m_kernels[index]->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                       (std::min(pixels_a_dispatch, n_pixels - first) + group_size - 1) / group_size);
        }
    }
    counts.field_evaluations += m_counts.read_items<std::uint32_t>(1)[0];
}

} // namespace elvis
