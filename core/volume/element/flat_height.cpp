#include <core/volume/element/flat_height.hpp>

#include <core/plugin_host/all_bounds.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

std::optional<double> flat_height(const RuntimeVolume& volume) {
    if (volume.dimension() != 2 || volume.n_elements() == 0) {
        return std::nullopt;
    }
    const std::vector<double> boxes = all_bounds(volume);
    double size = 0, lower = boxes[2], upper = boxes[5];
    for (std::size_t at = 0; at < boxes.size(); at += 6) {
        size = std::max({size, boxes[at + 3] - boxes[at], boxes[at + 4] - boxes[at + 1]});
        lower = std::min(lower, boxes[at + 2]);
        upper = std::max(upper, boxes[at + 5]);
    }
    return upper - lower <= on_surface * size ? std::optional(0.5 * (lower + upper)) : std::nullopt;
}

} // namespace elvis
