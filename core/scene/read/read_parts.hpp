/**
 * @file read_parts.hpp
 * Parts of a scene file.
 */
#pragma once

#include <core/scene/read/json_reader.hpp>
#include <core/scene/scene.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace elvis {

/** The first N numbers of a list whose length the schema has fixed. */
template <std::size_t N> std::array<double, N> fixed(const std::vector<double>& list) {
    std::array<double, N> result{};
    std::copy_n(list.begin(), N, result.begin());
    return result;
}

/** A path of the scene file, seen from the working directory. */
std::string beside(const std::string& scene, const std::string& path);

SceneAnimation read_animation(const JsonObject& object);
/** Of the key "annotation"; nothing for "none". */
std::optional<SceneAnnotation> read_annotation(const JsonObject& image, const std::string& scene);
SceneColorMap read_color_map(const JsonObject& object, const std::string& scene);
/** Of the key "lighting"; nothing for "none". Lights that are switched off go to `hidden`. */
std::optional<Lighting> read_lighting(const JsonObject& root, std::vector<Light>& hidden);
SceneLineStyle read_line_style(const JsonObject& object);
SceneContours read_contours(const JsonObject& object);
SceneLic read_lic(const JsonObject& object);
/** A surface given by a formula or a file. */
CutShape read_shape(const JsonObject& object, const std::string& type, const std::string& scene);
/** Of a surface of type "streamlines". */
SceneStreamlines read_streamlines(const JsonObject& object);
/** Of a surface of type "pathlines". */
SceneStreamlines read_pathlines(const JsonObject& object);
/** Of a surface of type "arrows". */
SceneArrows read_arrows(const JsonObject& object);
/** Of a surface of type "elements" or "wireframe". */
ElementSelection read_selection(const JsonObject& object);
WireFrame read_wireframe(const JsonObject& object);
/** A transfer function as it is, in a scene or a file of its own; its schema is "transfer". */
TransferFunction read_transfer(const JsonObject& object);
SceneVolumeRendering read_volume_rendering(const JsonObject& object, const std::string& scene);
/** `type`: what the key "type" says, or would say. */
SceneSurface read_surface(const JsonObject& object, const std::string& type, const std::string& scene);

} // namespace elvis
