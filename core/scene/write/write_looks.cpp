#include <core/scene/line_width.hpp>
#include <core/scene/write/write_parts.hpp>

namespace elvis {

namespace {

SceneJson rgb(const Color& color) { return {color[0], color[1], color[2]}; }

const char* space_name(ColorSpace space) {
    switch (space) {
    case ColorSpace::lab:
        return "lab";
    case ColorSpace::hsv:
        return "hsv";
    case ColorSpace::diverging:
        return "diverging";
    case ColorSpace::step:
        return "step";
    case ColorSpace::rgb:
        break;
    }
    return "rgb";
}

SceneJson light_json(const Light& light, bool is_shown) {
    const bool is_point = light.type == Light::Type::point;
    SceneJson json;
    json["type"] = is_point ? "point" : "directional";
    json[is_point ? "position" : "direction"] = light.vector;
    json["color"] = light.color;
    if (!is_shown) {
        json["visible"] = false;
    }
    return json;
}

SceneJson text_json(const AnnotationText& text) {
    SceneJson json;
    json["text"] = text.text;
    json["position"] = text.position;
    json["anchor"] = text.anchor;
    if (text.size) {
        json["size"] = *text.size;
    }
    if (text.color) {
        json["color"] = rgb(*text.color);
    }
    return json;
}

} // namespace

SceneJson color_map_json(const SceneColorMap& map, const std::string& scene) {
    SceneJson json = SceneJson::object();
    if (!map.name.empty()) {
        json["name"] = map.name;
    }
    if (!map.file.empty()) {
        json["file"] = seen_from(scene, map.file);
    }
    for (const SceneColorMap::Point& point : map.points) {
        json["points"].push_back({point.position, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    if (map.space != ColorSpace::rgb) {
        json["space"] = space_name(map.space);
    }
    if (map.is_logarithmic) {
        json["scale"] = "logarithmic";
    }
    if (map.range) {
        json["range"] = *map.range;
    }
    for (const auto& [key, color] : {std::pair{"below", map.below}, std::pair{"above", map.above}, std::pair{"nan", map.nan}}) {
        if (color) {
            json[key] = *color;
        }
    }
    return json;
}

SceneJson lic_json(const SceneLic& lic) {
    SceneJson json;
    json["field"] = lic.field;
    set(json, "length", lic.length);
    json["contrast"] = lic.contrast;
    return json;
}

SceneJson line_style_json(const SceneLineStyle& style) {
    SceneJson json = SceneJson::object(); // That nothing is said is an object, too.
    if (style.width != width_by_size) {
        json["width"] = style.width;
    }
    if (style.color) {
        json["color"] = *style.color;
    }
    if (style.undecided_color) {
        json["undecided_color"] = *style.undecided_color;
    }
    return json;
}

SceneJson contours_json(const SceneContours& contours) {
    SceneJson json = SceneJson::object(); // That nothing is said is an object, too.
    if (contours.count > 0) {
        json["count"] = contours.count;
    } else if (!contours.is_round) {
        json["values"] = contours.values;
    }
    if (contours.range) {
        json["range"] = *contours.range;
    }
    json.update(line_style_json(contours.style));
    if (contours.has_map_color) {
        json["color"] = "map";
    }
    return json;
}

SceneJson lighting_json(const Lighting& lighting, const std::vector<Light>& hidden) {
    SceneJson json;
    json["ambient"] = lighting.ambient;
    json["headlight"] = lighting.headlight;
    for (const Light& light : lighting.lights) {
        json["lights"].push_back(light_json(light, true));
    }
    for (const Light& light : hidden) {
        json["lights"].push_back(light_json(light, false));
    }
    json["specular"] = lighting.specular;
    json["exponent"] = lighting.exponent;
    return json;
}

SceneJson annotation_json(const SceneAnnotation& annotation, const std::string& scene) {
    const AnnotationRequest& style = annotation.style;
    SceneJson json;
    if (annotation.title) {
        json["title"] = *annotation.title;
    }
    json["color_bars"] = annotation.has_color_bars;
    json["axes"] = annotation.has_axes;
    for (const AnnotationText& text : style.texts) {
        json["texts"].push_back(text_json(text));
    }
    if (!style.font.empty()) {
        json["font"] = seen_from(scene, style.font);
    }
    if (style.color) {
        json["color"] = rgb(*style.color);
    }
    json["text_size"] = style.text_size;
    json["title_scale"] = style.title_scale;
    json["axes_size"] = style.axes_size;
    json["bar_side"] = style.bars_at_left ? "left" : "right";
    json["bar_length"] = style.bar_length;
    json["bar_width"] = style.bar_width;
    return json;
}

} // namespace elvis
