/**
 * @file write_parts.hpp
 * Parts of a scene file, as JSON.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace elvis {

using SceneJson = nlohmann::ordered_json;

/** `path` as a file in the folder of `scene` speaks of it. */
std::string seen_from(const std::string& scene, const std::string& path);

SceneJson color_map_json(const SceneColorMap& map, const std::string& scene);
SceneJson contours_json(const SceneContours& contours);
SceneJson line_style_json(const SceneLineStyle& style);
SceneJson lighting_json(const Lighting& lighting, const std::vector<Light>& hidden);
SceneJson annotation_json(const SceneAnnotation& annotation, const std::string& scene);
SceneJson surface_json(const SceneSurface& surface, const std::string& scene);
SceneJson volume_rendering_json(const SceneVolumeRendering& rendering, const std::string& scene);

} // namespace elvis
