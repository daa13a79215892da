#include <core/render/cut_surface/open_points.hpp>
#include <core/render/cut_surface/point_parameters.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>

#include <algorithm>
#include <iterator>
#include <string>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 32;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t pixels_a_dispatch = 1u << 15;

} // namespace

OpenPoints::OpenPoints(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool is_on_plane)
    : m_device(device), m_volume(volume), m_data(data), m_is_on_plane(is_on_plane), m_classes(volume.classes().size()) {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        if (volume.dimension() == 3 && ElementReaches::has_bent(data.curvatures(index))) {
            m_classes[index].reaches = std::make_unique<ElementReaches>(device, volume, data, index);
        }
    }
}

std::vector<FetchBuffer> OpenPoints::buffers(std::uint32_t element_class) const {
    const std::unique_ptr<ElementReaches>& reaches = m_classes[element_class].reaches;
    return reaches ? std::vector{reaches->records()} : std::vector<FetchBuffer>{};
}

std::array<const Buffer*, 2> OpenPoints::begin(std::uint32_t element_class, std::uint64_t n_pixels) {
    Buffer& list = provide_buffer(m_classes[element_class].list, m_device, (2 * n_pixels + 1) * sizeof(std::uint32_t));
    const std::uint32_t none = 0;
    list.write_items(std::span(&none, 1));
    const std::unique_ptr<ElementReaches>& reaches = m_classes[element_class].reaches;
    if (!reaches) {
        // Not written to.
        return {&list, &list};
    }
    reaches->begin();
    return {&list, &reaches->wanted()};
}

void OpenPoints::provide_kernel(std::uint32_t element_class) {
    OfClass& of_class = m_classes[element_class];
    if (of_class.kernel) {
        return;
    }
    of_class.octants = std::make_unique<ElementOctants>(m_device, m_volume, m_data, element_class);
    KernelRequest request;
    request.name = "open_points of element class " + std::to_string(element_class);
    request.kernel = "cut_surface/open_points.comp";
    request.precision = m_data.precision();
    request.buffers = m_data.host_buffers(element_class);
    std::ranges::copy(buffers(element_class), std::back_inserter(request.buffers));
    std::ranges::copy(of_class.octants->buffers(), std::back_inserter(request.buffers));
    m_data.add_field(request, element_class);
    request.defines = {{"CORE_GROUP_SIZE", std::to_string(group_size)},
                       {"CORE_CLASS", std::to_string(element_class) + "u"},
                       {"CORE_ON_PLANE", m_is_on_plane ? "1" : "0"}};
    request.bindings = buffer_bindings({.uniform = 1, .storage = m_is_on_plane ? 6u : 8u});
    request.push_constant_bytes = sizeof(PointParameters);
    of_class.kernel = std::make_unique<ComposedKernel>(m_device, request);
}

void OpenPoints::search(std::uint32_t element_class, const Surface& surface) {
    if (m_classes[element_class].reaches) {
        m_classes[element_class].reaches->provide();
    }
    const Buffer& list = *m_classes[element_class].list;
    const std::uint32_t n_listed = list.read_items<std::uint32_t>(1)[0];
    if (n_listed == 0) {
        return;
    }
    provide_kernel(element_class);
    const OfClass& of_class = m_classes[element_class];
    const Layer& layer = surface.target.layer;
    std::vector<const Buffer*> bindings = {&surface.frame,
                                           &layer.samples,
                                           &layer.marks,
                                           &surface.counts,
                                           &list,
                                           &of_class.octants->roots(),
                                           &of_class.octants->asked()};
    if (!m_is_on_plane) {
        bindings.insert(bindings.end(),
                        {surface.hits, surface.target.places != nullptr ? surface.target.places : &layer.normals});
    }
    of_class.octants->begin();
    PointParameters parameters(surface.target, surface.number, surface.component, surface.most_error);
    // Where octants were missing it is done again with them.
    do {
        in_batches(n_listed, pixels_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
            parameters.first = first;
            of_class.kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(count, group_size));
        });
    } while (of_class.octants->provide());
}

} // namespace elvis
