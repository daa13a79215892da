#include <core/render/cut_surface/open_points.hpp>
#include <core/render/cut_surface/point_parameters.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>

#include <algorithm>
#include <iterator>
#include <span>
#include <string>

namespace elvis {

namespace {

constexpr std::uint32_t open_points_group_size = 32;
/** Words of an entry of the list: shaders/cut_surface/open_points.glsl. */
constexpr std::uint64_t open_point_size = 3;
/** Pixels of one dispatch: bounds its time. */
constexpr std::uint32_t open_points_pixels_a_dispatch = 1u << 15;

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

Buffer& OpenPoints::empty_list(std::optional<Buffer>& list, std::uint64_t bytes) const {
    Buffer& provided = provide_buffer(list, m_device, bytes);
    const std::uint32_t none = 0;
    provided.write_items(std::span(&none, 1));
    return provided;
}

std::array<const Buffer*, 2> OpenPoints::begin(std::uint32_t element_class, std::uint64_t n_pixels) {
    const Buffer& list = empty_list(m_classes[element_class].list, (open_point_size * n_pixels + 1) * sizeof(std::uint32_t));
    const std::unique_ptr<ElementReaches>& reaches = m_classes[element_class].reaches;
    if (!reaches) {
        // Not written to.
        return {&list, &list};
    }
    reaches->begin();
    return {&list, &reaches->wanted()};
}

void OpenPoints::provide_kernels(std::uint32_t element_class) {
    OfClass& of_class = m_classes[element_class];
    if (of_class.search) {
        return;
    }
    of_class.octants = std::make_unique<ElementOctants>(m_device, m_volume, m_data, element_class);
    KernelRequest request;
    request.name = "sift_points of element class " + std::to_string(element_class);
    request.kernel = "cut_surface/sift_points.comp";
    request.precision = m_data.precision();
    request.instances = {m_data.instance(element_class)};
    request.buffers = m_data.host_buffers(element_class);
    std::ranges::copy(buffers(element_class), std::back_inserter(request.buffers));
    std::ranges::copy(of_class.octants->buffers(), std::back_inserter(request.buffers));
    request.defines = {{"CORE_GROUP_SIZE", std::to_string(open_points_group_size)},
                       {"CORE_ON_PLANE", m_is_on_plane ? "1" : "0"}};
    request.bindings = buffer_bindings({.uniform = 1, .storage = m_is_on_plane ? 6u : 7u});
    request.push_constant_bytes = sizeof(PointParameters);
    of_class.sift = std::make_unique<ComposedKernel>(m_device, request);

    request.name = "open_points of element class " + std::to_string(element_class);
    request.kernel = "cut_surface/open_points.comp";
    request.instances.clear();
    m_data.add_field(request, element_class);
    request.defines.emplace_back("CORE_CLASS", std::to_string(element_class) + "u");
    request.bindings = buffer_bindings({.uniform = 1, .storage = m_is_on_plane ? 6u : 8u});
    of_class.search = std::make_unique<ComposedKernel>(m_device, request);
}

void OpenPoints::search(std::uint32_t element_class, const Surface& surface) {
    OfClass& of_class = m_classes[element_class];
    const Buffer& list = *of_class.list;
    std::uint32_t n_listed = 0;
    const Buffer::Read of_list{&list, std::as_writable_bytes(std::span(&n_listed, 1))};
    if (of_class.reaches) {
        of_class.reaches->provide(of_list);
    } else {
        Buffer::read_together({of_list});
    }
    if (n_listed == 0) {
        return;
    }
    provide_kernels(element_class);
    of_class.octants->begin();
    // Where octants were missing it is done again with them.
    do {
        const Buffer& sifted = empty_list(m_sifted, list.bytes());
        dispatch(*of_class.sift, sifted, list, n_listed, of_class, surface);
        // Beyond the list kernels do nothing, which takes less time than to ask how long it is.
        const std::uint32_t n_sifted = m_device.collects_submissions() ? n_listed : sifted.read_items<std::uint32_t>(1)[0];
        dispatch(*of_class.search, surface.counts, sifted, n_sifted, of_class, surface);
    } while (of_class.octants->provide());
}

void OpenPoints::dispatch(const ComposedKernel& kernel, const Buffer& output, const Buffer& list, std::uint32_t n_listed,
                          const OfClass& of_class, const Surface& surface) const {
    const Layer& layer = surface.target.layer;
    std::vector<const Buffer*> bindings = {
        &surface.frame, &layer.samples, &layer.marks, &output, &list, &of_class.octants->roots(), &of_class.octants->asked()};
    if (!m_is_on_plane) {
        bindings.push_back(surface.hits);
        if (&kernel == of_class.search.get()) {
            bindings.push_back(surface.target.places != nullptr ? surface.target.places : &layer.normals);
        }
    }
    PointParameters parameters(surface.target, surface.number, surface.component, surface.most_error);
    in_batches(n_listed, items_a_dispatch(m_device, open_points_pixels_a_dispatch, open_points_group_size),
               [&](std::uint32_t first, std::uint32_t count) {
                   parameters.first = first;
                   kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                   divided_up(count, open_points_group_size));
               });
}

} // namespace elvis
