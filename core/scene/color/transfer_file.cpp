#include <core/scene/color/transfer.hpp>

#include <core/base/error.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/read/json_reader.hpp>
#include <core/scene/read/read_parts.hpp>

#include <cmath>
#include <fstream>

namespace elvis {

namespace {

using Json = nlohmann::json;

double number_of(const Json& value, const std::string& what, const std::string& path) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
        throw Error(path, what + " is " + value.dump() + ", where a number is expected");
    }
    return value.get<double>();
}

/** A number in [0, 1]. */
double part_of(const Json& value, const std::string& what, const std::string& path) {
    const double number = number_of(value, what, path);
    if (number < 0 || number > 1) {
        throw Error(path, what + " is " + value.dump() + "; it must be from 0 to 1");
    }
    return number;
}

std::vector<OpacityPoint> opacity_points(const Json& preset, const std::string& path) {
    const auto list = preset.find("Points");
    if (list == preset.end() || !list->is_array() || list->empty()) {
        throw Error(path, "has no list Points, from which density comes; without, it serves as a color_map");
    }
    if (list->size() % 4 != 0) {
        throw Error(path, "its list Points has " + std::to_string(list->size()) +
                              " numbers; they come in groups of four: value, opacity, midpoint, sharpness");
    }
    std::vector<OpacityPoint> points;
    for (std::size_t i = 0; i < list->size(); i += 4) {
        const auto place = [i](std::size_t part) { return "Points[" + std::to_string(i + part) + "]"; };
        OpacityPoint point{number_of((*list)[i], place(0), path), part_of((*list)[i + 1], place(1) + ", an opacity,", path),
                           part_of((*list)[i + 2], place(2) + ", a midpoint,", path),
                           part_of((*list)[i + 3], place(3) + ", a sharpness,", path)};
        if (!points.empty() && point.value < points.back().value) {
            throw Error(path, place(0) + " is " + (*list)[i].dump() + ", less than the value before; values must ascend");
        }
        points.push_back(point);
    }
    return points;
}

TransferFunction read_paraview(const Json& document, const std::string& path) {
    const Json& preset = document.is_array() && !document.empty() ? document.front() : document;
    // Says what is wrong with the colours.
    const ColorMap map = read_color_map_file(path);
    if (const auto scale = preset.find("UseLogScale");
        scale != preset.end() && *scale != Json(false) && *scale != Json(0) && !scale->is_null()) {
        throw Error(path,
                    "has UseLogScale set: transfer functions over the logarithm are not known; take log10(..) as the field");
    }
    TransferFunction transfer;
    for (const SceneColorMap::Point& point : map.points) {
        for (const double channel : point.rgb) {
            if (!(channel >= 0 && channel <= 1)) {
                throw Error(path, "RGBPoints has a color with a number outside 0 to 1");
            }
        }
    }
    for (const SceneColorMap::Point& point : piecewise_linear(map, volume_table_tolerance)) {
        transfer.color.push_back({point.position, point.rgb});
    }
    double unit_distance = 1;
    if (const auto distance = preset.find("ScalarOpacityUnitDistance"); distance != preset.end()) {
        unit_distance = number_of(*distance, "ScalarOpacityUnitDistance", path);
        if (!(unit_distance > 0)) {
            throw Error(path, "ScalarOpacityUnitDistance is " + distance->dump() + "; it must be above 0");
        }
    }
    transfer.density = density_from_opacity(opacity_points(preset, path), unit_distance);
    return transfer;
}

} // namespace

TransferFunction read_transfer_file(const std::string& path) {
    std::ifstream file(path);
    char first = 0;
    if (!(file >> first)) {
        throw Error(path, "cannot be read, or is empty");
    }
    if (first == '<') {
        throw Error(path, "is XML; a transfer function is JSON with color and density, or ParaView's JSON with Points");
    }
    const Json document = parse_json_file(path);
    if (document.is_array() || document.contains("RGBPoints")) {
        return read_paraview(document, path);
    }
    static const Json schema = Json::parse(scene_schema_text()).at("$defs").at("transfer");
    return read_transfer(JsonObject(document, schema, path, ""));
}

} // namespace elvis
