#include <core/base/error.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/read/json_reader.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace elvis {

namespace {

double xml_number(const pugi::xml_node& node, const char* name, const std::string& path) {
    const std::string text = node.attribute(name).as_string();
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == 0 || used != text.size() || !std::isfinite(value)) {
        throw Error(path, std::string("a ") + node.name() + " has no number as its attribute '" + name + "'");
    }
    return value;
}

Rgb xml_color(const pugi::xml_node& node, const std::string& path) {
    return {xml_number(node, "r", path), xml_number(node, "g", path), xml_number(node, "b", path)};
}

/** <ColorMap space="RGB"> <Point x= o= r= g= b=/> ... <NaN r= g= b=/> </ColorMap>; opacity o plays no part on surfaces. */
ColorMap read_xml(const std::string& path) {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_file(path.c_str());
    if (!result) {
        throw Error(path, "is not XML: " + std::string(result.description()) + " at byte " + std::to_string(result.offset));
    }
    const pugi::xml_node root = document.child("ColorMap");
    if (!root) {
        throw Error(path, "has no element ColorMap");
    }
    ColorMap map;
    const std::string space = root.attribute("space").as_string("RGB");
    if (space == "Lab" || space == "HSV" || space == "Diverging") {
        map.space = space == "Lab" ? ColorSpace::lab : space == "HSV" ? ColorSpace::hsv : ColorSpace::diverging;
    } else if (space != "RGB") {
        throw Error(path, "the colour space '" + space + "' is unknown");
    }
    for (const pugi::xml_node& node : root.children("Point")) {
        map.points.push_back({xml_number(node, "x", path), xml_color(node, path)});
    }
    if (const pugi::xml_node nan = root.child("NaN")) {
        map.nan = xml_color(nan, path);
    }
    return map;
}

/** ParaView's presets: a list of maps, of which the first is taken, or one map. */
ColorMap read_paraview(const std::string& path) {
    nlohmann::json document = parse_json_file(path);
    const nlohmann::json& preset = document.is_array() && !document.empty() ? document.front() : document;
    if (!preset.is_object() || !preset.contains("RGBPoints") || !preset["RGBPoints"].is_array() ||
        preset["RGBPoints"].size() % 4 != 0) {
        throw Error(path, "is no ParaView colour map: it has no list RGBPoints of groups of four numbers");
    }
    ColorMap map;
    const nlohmann::json named = preset.value("ColorSpace", nlohmann::json("RGB"));
    const std::string space = named.is_string() ? named.get<std::string>() : named.dump();
    if (space == "Lab" || space == "CIELAB" || space == "Lab/CIEDE2000") {
        map.space = ColorSpace::lab;
    } else if (space == "HSV" || space == "Diverging" || space == "Step") {
        map.space = space == "HSV" ? ColorSpace::hsv : space == "Step" ? ColorSpace::step : ColorSpace::diverging;
    } else if (space != "RGB") {
        throw Error(path, "the colour space '" + space + "' is unknown");
    }
    const nlohmann::json& numbers = preset["RGBPoints"];
    for (const nlohmann::json& number : numbers) {
        if (!number.is_number()) {
            throw Error(path, "RGBPoints holds something else than numbers");
        }
    }
    for (std::size_t at = 0; at < numbers.size(); at += 4) {
        map.points.push_back({numbers[at].get<double>(),
                              {numbers[at + 1].get<double>(), numbers[at + 2].get<double>(), numbers[at + 3].get<double>()}});
    }
    const auto is_number = [](const nlohmann::json& value) { return value.is_number(); };
    if (const auto nan = preset.find("NanColor");
        nan != preset.end() && nan->is_array() && nan->size() == 3 && std::all_of(nan->begin(), nan->end(), is_number)) {
        map.nan = Rgb{(*nan)[0].get<double>(), (*nan)[1].get<double>(), (*nan)[2].get<double>()};
    }
    return map;
}

} // namespace

ColorMap read_color_map_file(const std::string& path) {
    std::ifstream file(path);
    char first = 0;
    if (!(file >> first)) {
        throw Error(path, "cannot be read, or is empty");
    }
    ColorMap map = first == '<' ? read_xml(path) : read_paraview(path);
    if (map.points.empty()) {
        throw Error(path, "has no colours");
    }
    for (std::size_t index = 1; index < map.points.size(); ++index) {
        if (map.points[index].position < map.points[index - 1].position) {
            throw Error(path, "the positions of its colours do not ascend");
        }
    }
    return map;
}

} // namespace elvis
