#include <core/render/live_rays.hpp>
#include <core/render/pixel_kernel.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace elvis {

struct LiveRays::Parameters {
    std::uint32_t width, height;
    std::uint32_t tiles_a_row, first_tile_row;
    std::uint32_t seeks;
    std::uint32_t first_element, n_elements;
};

namespace {

/** Of a device that is the processor, where a dispatch costs as much as some hundred tiles; of others, which want large ones. */
constexpr double most_waste_of_processor = 1.2, most_waste_of_others = 1e30;

KernelRequest request_for(Precision precision, std::uint32_t tile_width, std::uint32_t tile_height, std::size_t push_bytes) {
    KernelRequest request =
        pixel_kernel("live_rays", precision, {BindingType::storage_buffer, BindingType::storage_buffer, BindingType::storage_buffer}, push_bytes);
    request.defines = {{"CORE_TILE_WIDTH", std::to_string(tile_width) + "u"}, {"CORE_TILE_HEIGHT", std::to_string(tile_height) + "u"}};
    return request;
}

} // namespace

std::vector<RayBox> boxes_of(std::span<const std::uint32_t> ranges, std::uint32_t tile_height, std::uint32_t height,
                             double most_waste) {
    std::vector<RayBox> boxes;
    // What the last box holds of ranges.
    std::uint64_t held = 0;
    for (std::uint32_t row = 0; 2 * row < ranges.size(); ++row) {
        const RayBox own{ranges[2 * row], ranges[2 * row + 1], row * tile_height, std::min((row + 1) * tile_height, height)};
        if (own.first >= own.end) {
            continue;
        }
        if (!boxes.empty()) {
            RayBox both = boxes.back();
            both.first = std::min(both.first, own.first);
            both.end = std::max(both.end, own.end);
            both.end_row = own.end_row;
            if (static_cast<double>(both.area()) <= most_waste * static_cast<double>(held + own.area())) {
                boxes.back() = both;
                held += own.area();
                continue;
            }
        }
        boxes.push_back(own);
        held = own.area();
    }
    return boxes;
}

LiveRays::LiveRays(const Device& device, Precision precision, std::uint32_t tile_width, std::uint32_t tile_height)
    : m_device(device), m_tile_width(tile_width), m_tile_height(tile_height),
      m_most_waste(device.summary().type == "cpu" ? most_waste_of_processor : most_waste_of_others),
      m_kernel(device, request_for(precision, tile_width, tile_height, sizeof(Parameters))) {}

void LiveRays::begin(const Buffer& states, const Buffer& has_starts, std::uint32_t width, std::uint32_t height) {
    m_states = &states;
    m_has_starts = &has_starts;
    m_width = width;
    m_height = height;
    m_all = {0, (width + m_tile_width - 1) / m_tile_width, 0, height};
    m_is_first = true;
}

std::vector<RayBox> LiveRays::run(std::uint32_t seeks, std::uint32_t first_element, std::uint32_t n_elements) {
    const std::uint32_t tiles_a_row = (m_width + m_tile_width - 1) / m_tile_width;
    const std::uint32_t tile_rows = (m_height + m_tile_height - 1) / m_tile_height;
    const std::uint64_t bytes = std::uint64_t{tile_rows} * 2 * sizeof(std::uint32_t);
    if (!m_ranges || m_ranges->bytes() != bytes) {
        m_ranges.reset();
        m_ranges.emplace(m_device, bytes);
    }
    std::vector<std::uint32_t> ranges(2 * std::size_t{tile_rows}, 0);
    for (std::size_t i = 0; i < ranges.size(); i += 2) {
        ranges[i] = 0xffffffffu;
    }
    m_ranges->write_items(std::span<const std::uint32_t>(ranges));
    const Parameters parameters{m_width, m_height, tiles_a_row, m_all.first_row / m_tile_height, seeks, first_element, n_elements};
    const std::array<const Buffer*, 3> bindings = {m_states, &*m_ranges, m_has_starts};
    const std::uint32_t end_tile_row = (m_all.end_row + m_tile_height - 1) / m_tile_height;
    if (m_all.area() > 0) {
        m_kernel.dispatch_from({m_all.first, 0}, bindings, std::as_bytes(std::span(&parameters, 1)), m_all.end - m_all.first,
                               end_tile_row - parameters.first_tile_row);
    }
    ranges = m_ranges->read_items<std::uint32_t>(ranges.size());
    return boxes_of(ranges, m_tile_height, m_height, m_most_waste);
}

std::vector<RayBox> LiveRays::seeking() {
    std::vector<RayBox> boxes = run(1, 0, 0);
    if (m_is_first) {
        m_is_first = false;
        m_all = {};
        for (const RayBox& box : boxes) {
            const bool is_empty = m_all.area() == 0;
            m_all.first = is_empty ? box.first : std::min(m_all.first, box.first);
            m_all.end = std::max(m_all.end, box.end);
            m_all.first_row = is_empty ? box.first_row : m_all.first_row;
            m_all.end_row = box.end_row;
        }
    }
    return boxes;
}

std::vector<RayBox> LiveRays::going(std::uint32_t first_element, std::uint32_t n_elements) {
    return run(0, first_element, n_elements);
}

} // namespace elvis
