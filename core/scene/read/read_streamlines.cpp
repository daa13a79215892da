#include <core/scene/read/read_parts.hpp>

namespace elvis {

namespace {

SceneStreamlines::Direction direction_of(const JsonObject& object) {
    const std::string word = object.word("direction");
    return word == "forward"    ? SceneStreamlines::Direction::forward
           : word == "backward" ? SceneStreamlines::Direction::backward
                                : SceneStreamlines::Direction::both;
}

ScenePathTimes read_path_times(const JsonObject& object) {
    ScenePathTimes times;
    if (object.has("start_time")) {
        times.start = object.number("start_time");
    }
    if (object.has("end_time")) {
        times.end = object.number("end_time");
    }
    times.is_linear = object.has("interpolation") && object.word("interpolation") == "linear";
    return times;
}

void read_seeds(const JsonObject& object, SceneStreamlines& lines) {
    if (object.has("seeds")) {
        for (const std::vector<double>& seed : object.rows("seeds")) {
            lines.seeds.push_back(fixed<3>(seed));
        }
    }
    if (object.has("seed_line")) {
        const std::vector<std::vector<double>> ends = object.rows("seed_line");
        lines.seed_line = {fixed<3>(ends[0]), fixed<3>(ends[1])};
    }
    if (object.has("seed_count")) {
        lines.seed_count = object.integer("seed_count");
    }
    if (object.has("on")) {
        lines.on = object.text("on");
    }
    if (object.has("spacing")) {
        lines.spacing = object.number("spacing");
    }
    if (object.has("seed_grid")) {
        lines.seed_grid = object.integer("seed_grid");
    }
}

} // namespace

SceneStreamlines read_streamlines(const JsonObject& object) {
    SceneStreamlines lines;
    lines.flow = object.text("flow");
    read_seeds(object, lines);
    if (object.has("direction")) {
        lines.direction = direction_of(object);
    }
    if (object.has("length")) {
        lines.length = object.number("length");
    }
    if (object.has("tolerance")) {
        lines.tolerance = object.number("tolerance");
    }
    if (object.has("radius")) {
        lines.radius = object.number("radius");
    }
    if (object.has("ribbon_width")) {
        lines.ribbon_width = object.number("ribbon_width");
    }
    return lines;
}

SceneStreamlines read_pathlines(const JsonObject& object) {
    SceneStreamlines lines = read_streamlines(object);
    lines.times = read_path_times(object);
    if (!object.has("direction")) {
        lines.direction = SceneStreamlines::Direction::forward;
    }
    if (lines.times->end && lines.direction == SceneStreamlines::Direction::both) {
        object.fail("end_time", "is of one direction, which is forward or backward, not both");
    }
    return lines;
}

SceneArrows read_arrows(const JsonObject& object) {
    SceneArrows arrows;
    arrows.vectors = object.text("vectors");
    if (object.has("on")) {
        arrows.on = object.text("on");
    }
    if (object.has("spacing")) {
        arrows.spacing = object.number("spacing");
    }
    if (object.has("scale")) {
        arrows.scale = object.number("scale");
    }
    return arrows;
}

} // namespace elvis
