#include <core/scene/read/read_parts.hpp>

namespace elvis {

namespace {

Light read_light(const JsonObject& object) {
    Light light;
    const bool is_point = object.word("type") == "point";
    const char* key = is_point ? "position" : "direction";
    light.type = is_point ? Light::Type::point : Light::Type::directional;
    light.vector = fixed<3>(object.numbers(key));
    if (!is_point && light.vector == Vector3{}) {
        object.fail(key, "has length zero");
    }
    if (object.has("color")) {
        light.color = fixed<3>(object.numbers("color"));
    }
    return light;
}

} // namespace

std::optional<Lighting> read_lighting(const JsonObject& root, std::vector<Light>& hidden) {
    if (root.raw("lighting").is_string()) {
        return root.word("lighting") == "default" ? std::optional(Lighting{}) : std::nullopt;
    }
    const JsonObject object = root.object("lighting");
    Lighting lighting;
    if (object.has("ambient")) {
        lighting.ambient = fixed<3>(object.numbers("ambient"));
    }
    if (object.has("headlight")) {
        lighting.headlight = fixed<3>(object.numbers("headlight"));
    }
    if (object.has("lights")) {
        for (const JsonObject& light : object.objects("lights")) {
            const bool is_shown = !light.has("visible") || light.flag("visible");
            (is_shown ? lighting.lights : hidden).push_back(read_light(light));
        }
    }
    if (object.has("specular")) {
        lighting.specular = object.number("specular");
    }
    if (object.has("exponent")) {
        lighting.exponent = object.number("exponent");
    }
    return lighting;
}

} // namespace elvis
