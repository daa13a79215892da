#include "color.hpp"

#include <cmath>

namespace elvis::oracle {

Color color_of(const ColorTable& table, double value) {
    if (std::isnan(value) || (table.is_logarithmic && value <= 0))
        return table.nan;
    if (value < table.points.front().value)
        return table.below;
    if (value > table.points.back().value)
        return table.above;
    // Last point not above the value.
    std::size_t i = 0;
    while (i + 1 < table.points.size() && table.points[i + 1].value <= value)
        ++i;
    const ColorTable::Point& low = table.points[i];
    Color color{low.rgb[0], low.rgb[1], low.rgb[2], 1};
    if (i + 1 == table.points.size())
        return color;
    const ColorTable::Point& high = table.points[i + 1];
    const double t = (value - low.value) / (high.value - low.value);
    for (std::size_t channel = 0; channel < 3; ++channel)
        color[channel] = (1 - t) * low.rgb[channel] + t * high.rgb[channel];
    return color;
}

} // namespace elvis::oracle
