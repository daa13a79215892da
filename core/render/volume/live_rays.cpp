#include <core/render/device/in_batches.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/volume/live_rays.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

namespace elvis {

struct LiveRays::Parameters {
    std::uint32_t width, height;
    std::uint32_t first, n_groups;
    std::uint32_t seeks;
    std::uint32_t first_element, n_elements;
};

namespace {

/** Groups of rays that a work group of the kernel looks at: CORE_GROUPS. */
constexpr std::uint32_t groups_a_work_group = 16;
/** Of m_counts: in front, the size of a dispatch for the live ones. */
struct LiveRaysCount {
    enum : std::size_t { live, live_y, live_z, open, n_counts };
};
constexpr std::array<std::uint32_t, LiveRaysCount::n_counts> none_yet = {0, 1, 1, 0};

KernelRequest live_rays_request(Precision precision, std::uint32_t tile_width, std::uint32_t tile_height,
                                std::size_t push_bytes) {
    KernelRequest request = pixel_kernel("volume/live_rays", precision, {.storage = 6}, push_bytes);
    request.defines = {{"CORE_TILE_WIDTH", std::to_string(tile_width) + "u"},
                       {"CORE_TILE_HEIGHT", std::to_string(tile_height) + "u"},
                       {"CORE_GROUPS", std::to_string(groups_a_work_group) + "u"},
                       GroupShape(tile_width).define()};
    return request;
}

} // namespace

GroupShape::GroupShape(std::uint32_t tile_width) : width(tile_width), height(1) {
    while (width > 2 * height) {
        width /= 2;
        height *= 2;
    }
}

std::pair<std::string, std::string> GroupShape::define() const { return {"CORE_GROUP_WIDTH", std::to_string(width) + "u"}; }

RayGroups AllRayGroups::of(const Device& device, const GroupShape& shape, std::uint32_t width, std::uint32_t height) {
    const std::uint32_t n_groups = divided_up(width, shape.width) * divided_up(height, shape.height);
    const std::uint64_t bytes = std::uint64_t{n_groups} * sizeof(std::uint32_t);
    if (!m_list || m_list->bytes() != bytes) {
        std::vector<std::uint32_t> all(n_groups);
        std::iota(all.begin(), all.end(), 0u);
        provide_buffer(m_list, device, bytes).write_items(std::span<const std::uint32_t>(all));
    }
    return {&*m_list, n_groups};
}

LiveRays::LiveRays(const Device& device, Precision precision, std::uint32_t tile_width, std::uint32_t tile_height)
    : m_device(device), m_shape(tile_width),
      m_kernel(device, live_rays_request(precision, tile_width, tile_height, sizeof(Parameters))),
      m_counts(device, LiveRaysCount::n_counts * sizeof(std::uint32_t)) {}

void LiveRays::begin(const Buffer& states, const Buffer& has_starts, std::uint32_t width, std::uint32_t height) {
    m_states = &states;
    m_has_starts = &has_starts;
    m_width = width;
    m_height = height;
    m_all = m_all_groups.of(m_device, m_shape, width, height);
    m_open = m_all;
    m_is_indirect = m_device.collects_submissions() && m_all.count <= m_device.limits().maxComputeWorkGroupCount[0];
    for (std::optional<Buffer>* list : {&m_live, &m_open_lists[0], &m_open_lists[1]}) {
        provide_buffer(*list, m_device, m_all.list->bytes());
    }
}

RayGroups LiveRays::run(std::uint32_t seeks, std::uint32_t first_element, std::uint32_t n_elements) {
    m_counts.write_items<std::uint32_t>(none_yet);
    const Buffer& next_open = *m_open_lists[m_next_open];
    const std::array<const Buffer*, 6> bindings = {m_states, m_has_starts, m_open.list, &*m_live, &next_open, &m_counts};
    in_batches(m_open.count, most_groups, [&](std::uint32_t first, std::uint32_t count) {
        const Parameters parameters{m_width, m_height, first, count, seeks, first_element, n_elements};
        m_kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(count, groups_a_work_group));
    });
    if (m_is_indirect) {
        // Of all groups each time: what is open is not known here.
        return {&*m_live, m_all.count, &m_counts};
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(LiveRaysCount::n_counts);
    if (seeks != 0) {
        m_open = {&next_open, found[LiveRaysCount::open]};
        m_next_open = 1 - m_next_open;
    }
    return {&*m_live, found[LiveRaysCount::live]};
}

RayGroups LiveRays::seeking() { return run(1, 0, 0); }

RayGroups LiveRays::going(std::uint32_t first_element, std::uint32_t n_elements) { return run(0, first_element, n_elements); }

} // namespace elvis
