#include <core/parts/all_boxes.hpp>

#include <algorithm>

namespace elvis {

namespace {

/** Elements whose bounds are read at once. */
constexpr std::uint64_t boxes_at_once = 16384;

void append_boxes(const RuntimeVolume& volume, const Span& elements, const TaskControl* control, std::vector<double>& boxes) {
    for (std::uint64_t done = 0; done < elements.size(); done += boxes_at_once) {
        if (control != nullptr) {
            control->check();
        }
        const std::uint64_t count = std::min(boxes_at_once, elements.size() - done);
        boxes.resize(boxes.size() + 6 * count);
        volume.bounds(elements.first + done, count, std::span(boxes).last(6 * count));
    }
}

} // namespace

std::vector<double> all_boxes(const RuntimeVolume& whole, const Partition& partition, Team& team, const TaskControl* control) {
    const Span own = own_parts(partition, team);
    std::vector<double> read;
    for (std::uint64_t part = own.first; part < own.end; ++part) {
        for (const Span& run : partition.runs(part)) {
            append_boxes(whole, run, control, read);
        }
    }
    return in_order_of_elements(partition, team.joined(std::move(read)));
}

} // namespace elvis
