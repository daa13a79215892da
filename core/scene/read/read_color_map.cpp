#include <core/scene/read/read_parts.hpp>

namespace elvis {

SceneColorMap read_color_map(const JsonObject& object, const std::string& scene) {
    SceneColorMap map;
    if (object.has("name")) {
        map.name = object.text("name");
    }
    if (object.has("file")) {
        map.file = beside(scene, object.text("file"));
    }
    if (object.has("points")) {
        for (const std::vector<double>& row : object.rows("points")) {
            if (!map.points.empty() && row[0] < map.points.back().position) {
                object.fail("points", "must have ascending positions");
            }
            map.points.push_back({row[0], {row[1], row[2], row[3]}});
        }
    }
    if (object.has("space")) {
        const std::string space = object.word("space");
        map.space = space == "lab"         ? ColorSpace::lab
                    : space == "hsv"       ? ColorSpace::hsv
                    : space == "diverging" ? ColorSpace::diverging
                    : space == "step"      ? ColorSpace::step
                                           : ColorSpace::rgb;
    }
    map.is_logarithmic = object.has("scale") && object.word("scale") == "logarithmic";
    if (object.has("range")) {
        map.range = fixed<2>(object.numbers("range"));
        if (!((*map.range)[0] < (*map.range)[1])) {
            object.fail("range", "must go from a smaller to a larger value");
        }
        if (map.is_logarithmic && !((*map.range)[0] > 0)) {
            object.fail("range", "must be above 0 on a logarithmic scale");
        }
    }
    if (object.has("below")) {
        map.below = fixed<3>(object.numbers("below"));
    }
    if (object.has("above")) {
        map.above = fixed<3>(object.numbers("above"));
    }
    if (object.has("nan")) {
        map.nan = fixed<3>(object.numbers("nan"));
    }
    return map;
}

} // namespace elvis
