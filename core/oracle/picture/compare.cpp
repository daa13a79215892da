#include "compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace elvis::oracle {
namespace {

// NaN on one side only is an error of 1, the whole channel.
double channel_error(const Frame& frame, std::size_t pixel, const Color& exact) {
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double error = std::abs(frame.color[4 * pixel + i] - exact[i]);
        largest = std::max(largest, std::isnan(error) ? 1.0 : error);
    }
    return largest;
}

} // namespace

Comparison compare(const Model& model, const Picture& exact, const Frame& frame, double color_tolerance) {
    if (frame.width != exact.width || frame.height != exact.height)
        throw std::invalid_argument("pictures of different size");
    Comparison result;
    result.pixels = exact.is_inside.size();
    Inverter inverter(model.volume, model.enclosures);
    auto alternative = exact.alternatives.begin();
    for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
        const auto first = alternative;
        while (alternative != exact.alternatives.end() && alternative->pixel == pixel)
            ++alternative;

        const bool frame_inside = frame.element[pixel] >= 0;
        const bool is_flagged = (frame.flags[pixel] & pixel_flag::undecided) != 0;
        result.newton_failures += (frame.flags[pixel] & pixel_flag::newton_failure) != 0;
        if (frame_inside != (exact.is_inside[pixel] != 0)) {
            const double distance = distance_to_edge(model, inverter, exact.position[pixel]);
            result.disagreements.push_back({pixel, !frame_inside, distance});
            result.max_edge_distance = std::max(result.max_edge_distance, distance);
            continue;
        }
        if (!frame_inside)
            continue;
        ++result.both_inside;
        result.needless_flags += is_flagged && first == alternative;
        result.other_element += frame.element[pixel] != exact.element[pixel];

        const double error = channel_error(frame, pixel, exact.color[pixel]);
        const bool shows_alternative = error > color_tolerance && std::any_of(first, alternative, [&](const Alternative& a) {
                                           return channel_error(frame, pixel, a.color) <= color_tolerance;
                                       });
        if (shows_alternative && is_flagged) {
            ++result.flagged_alternatives;
            continue;
        }
        if (error > result.max_channel_error) {
            result.max_channel_error = error;
            result.worst_pixel = pixel;
        }
        result.max_value_error = std::max(result.max_value_error, std::abs(frame.value[pixel] - exact.value[pixel]));
        result.max_depth_error = std::max(result.max_depth_error, std::abs(frame.depth[pixel] - exact.depth[pixel]));
    }
    return result;
}

std::string to_text(const Comparison& c) {
    char text[512];
    std::snprintf(text, sizeof text,
                  "inside %zu of %zu  channel error %.3g (pixel %zu)  value error %.3g  depth error %.3g  "
                  "other side, flagged %zu  needlessly flagged %zu  other element %zu  "
                  "disagree about inside %zu (%.4f %%, farthest from the edge %.1g)  Newton failures %zu",
                  c.both_inside, c.pixels, c.max_channel_error, c.worst_pixel, c.max_value_error, c.max_depth_error,
                  c.flagged_alternatives, c.needless_flags, c.other_element, c.disagreements.size(),
                  100 * c.disagreement_share(), c.max_edge_distance, c.newton_failures);
    return text;
}

} // namespace elvis::oracle
