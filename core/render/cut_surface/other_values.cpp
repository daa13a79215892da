#include <core/render/cut_surface/other_values.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/vulkan/real_array.hpp>

#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t other_values_group_size = 64;
/** Entries of one dispatch: bounds its time. */
constexpr std::uint32_t entries_a_dispatch = 1u << 18;

struct OtherValuesParameters {
    std::uint32_t first;
    std::uint32_t first_component, end_component;
    float value_tolerance;
};

} // namespace

const Buffer& OtherValues::begin(std::uint64_t n_pixels, const ShownComponent& component) {
    const std::uint64_t real = real_bytes(m_data.precision());
    // Three coordinates and two words an entry, behind one word, aligned. Continuous fields list nothing.
    const std::uint64_t n_entries = component.is_discontinuous ? n_pixels : 1;
    Buffer& list = provide_buffer(m_list, m_device, real + n_entries * (3 * real + 2 * sizeof(std::uint32_t)));
    const std::uint32_t none = 0;
    list.write_items(std::span(&none, 1));
    return list;
}

const ComposedKernel& OtherValues::kernel(std::uint32_t element_class) {
    if (element_class >= m_kernels.size()) {
        m_kernels.resize(element_class + 1);
    }
    if (!m_kernels[element_class]) {
        KernelRequest request;
        request.name = "other_values of element class " + std::to_string(element_class);
        request.kernel = "cut_surface/other_values.comp";
        request.precision = m_data.precision();
        m_data.add_field(request, element_class);
        request.defines = {{"CORE_GROUP_SIZE", std::to_string(other_values_group_size)}};
        request.bindings = buffer_bindings({.storage = 3});
        request.push_constant_bytes = sizeof(OtherValuesParameters);
        m_kernels[element_class] = std::make_unique<ComposedKernel>(m_device, request);
    }
    return *m_kernels[element_class];
}

void OtherValues::compare(std::uint32_t element_class, const ShownComponent& component, const Layer& layer,
                          FrameCounts& counts) {
    const std::uint32_t n_listed = component.is_discontinuous ? m_list->read_items<std::uint32_t>(1)[0] : 0;
    const std::array<const Buffer*, 3> bindings = {&layer.samples, &layer.marks, &*m_list};
    in_batches(n_listed, items_a_dispatch(m_device, entries_a_dispatch, other_values_group_size),
               [&](std::uint32_t first, std::uint32_t count) {
                   const OtherValuesParameters parameters{first, component.first(), component.end(), component.value_tolerance};
                   kernel(element_class)
                       .dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                 divided_up(count, other_values_group_size));
               });
    counts.field_evaluations += std::uint64_t{n_listed} * (component.end() - component.first());
}

} // namespace elvis
