/**
 * @file write_parts.hpp
 * Parts of a scene file, as JSON.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace elvis {

using SceneJson = nlohmann::ordered_json;

/** Sets what is there. */
template <class T> void set(SceneJson& json, const char* key, const std::optional<T>& value) {
    if (value) {
        json[key] = *value;
    }
}

/** `path` as a file in the folder of `scene` speaks of it. */
std::string seen_from(const std::string& scene, const std::string& path);

SceneJson color_map_json(const SceneColorMap& map, const std::string& scene);
SceneJson contours_json(const SceneContours& contours);
SceneJson line_style_json(const SceneLineStyle& style);
SceneJson lic_json(const SceneLic& lic);
SceneJson lighting_json(const Lighting& lighting, const std::vector<Light>& hidden);
SceneJson annotation_json(const SceneAnnotation& annotation, const std::string& scene);
SceneJson surface_json(const SceneSurface& surface, const std::string& scene);
SceneJson animation_json(const SceneAnimation& animation);
SceneJson volume_rendering_json(const SceneVolumeRendering& rendering, const std::string& scene);

} // namespace elvis
