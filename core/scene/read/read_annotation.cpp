#include <core/scene/read/read_parts.hpp>

namespace elvis {

namespace {

Color opaque(const std::vector<double>& rgb) { return {rgb[0], rgb[1], rgb[2], 1}; }

AnnotationText read_text(const JsonObject& object) {
    AnnotationText text;
    text.text = object.text("text");
    text.position = fixed<2>(object.numbers("position"));
    if (object.has("anchor")) {
        text.anchor = fixed<2>(object.numbers("anchor"));
    }
    if (object.has("size")) {
        text.size = object.number("size");
    }
    if (object.has("color")) {
        text.color = opaque(object.numbers("color"));
    }
    return text;
}

SceneAnnotation read_own(const JsonObject& object, const std::string& scene) {
    SceneAnnotation annotation;
    AnnotationRequest& style = annotation.style;
    if (object.has("title")) {
        annotation.title = object.text("title");
    }
    if (object.has("color_bars")) {
        annotation.has_color_bars = object.flag("color_bars");
    }
    if (object.has("axes")) {
        annotation.has_axes = object.flag("axes");
    }
    if (object.has("texts")) {
        for (const JsonObject& text : object.objects("texts")) {
            style.texts.push_back(read_text(text));
        }
    }
    if (object.has("font")) {
        style.font = beside(scene, object.text("font"));
    }
    if (object.has("color")) {
        style.color = opaque(object.numbers("color"));
    }
    const auto set = [&object](const char* key, double& size) { size = object.has(key) ? object.number(key) : size; };
    set("text_size", style.text_size);
    set("title_scale", style.title_scale);
    set("axes_size", style.axes_size);
    set("bar_length", style.bar_length);
    set("bar_width", style.bar_width);
    if (object.has("bar_side")) {
        style.bars_at_left = object.word("bar_side") == "left";
    }
    return annotation;
}

} // namespace

std::optional<SceneAnnotation> read_annotation(const JsonObject& image, const std::string& scene) {
    if (!image.raw("annotation").is_string()) {
        return read_own(image.object("annotation"), scene);
    }
    return image.word("annotation") == "default" ? std::optional(SceneAnnotation{}) : std::nullopt;
}

} // namespace elvis
