#include "palette.hpp"

#include <core/scene/color/color_map.hpp>

namespace elvis::serve {

nlohmann::json palette_of(const SceneColorMap& map) {
    constexpr double tolerance = 0.01;
    SceneColorMap plain = map;
    plain.range.reset();
    plain.is_logarithmic = false;
    auto points = nlohmann::json::array();
    for (const ColorTable::Point& point : make_color_table(plain, {0, 1}, tolerance).points) {
        points.push_back({point.value, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    return points;
}

} // namespace elvis::serve
