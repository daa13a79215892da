#include <core/render/live_rays.hpp>
#include <core/render/pixel_kernel.hpp>

#include <algorithm>
#include <array>

namespace elvis {

struct LiveRays::Parameters {
    std::uint32_t width, height;
    std::uint32_t seeks;
    std::uint32_t first_element, n_elements;
};

namespace {

/** Of a device that is the processor, where a dispatch costs as much as some hundred tiles; of others, which want large ones. */
constexpr double most_waste_of_processor = 1.2, most_waste_of_others = 1e30;

KernelRequest request_for(Precision precision, std::uint32_t tile_width, std::uint32_t tile_height, std::size_t push_bytes) {
    KernelRequest request =
        pixel_kernel("live_rays", precision, {BindingType::storage_buffer, BindingType::storage_buffer}, push_bytes);
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

std::vector<RayBox> LiveRays::run(const Buffer& states, const Parameters& parameters) {
    const std::uint32_t tiles_a_row = (parameters.width + m_tile_width - 1) / m_tile_width;
    const std::uint32_t tile_rows = (parameters.height + m_tile_height - 1) / m_tile_height;
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
    const std::array<const Buffer*, 2> bindings = {&states, &*m_ranges};
    m_kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), tiles_a_row, tile_rows);
    ranges = m_ranges->read_items<std::uint32_t>(ranges.size());
    return boxes_of(ranges, m_tile_height, parameters.height, m_most_waste);
}

std::vector<RayBox> LiveRays::seeking(const Buffer& states, std::uint32_t width, std::uint32_t height) {
    return run(states, {width, height, 1, 0, 0});
}

std::vector<RayBox> LiveRays::going(const Buffer& states, std::uint32_t width, std::uint32_t height, std::uint32_t first_element,
                                    std::uint32_t n_elements) {
    return run(states, {width, height, 0, first_element, n_elements});
}

} // namespace elvis
