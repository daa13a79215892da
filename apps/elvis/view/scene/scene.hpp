/**
 * @file scene.hpp
 * The scene that people change: the document of a scene file, each part in its full form, as elvis_scene_write_text has it.
 * What may stand in it is the library's matter (scene.schema.json).
 */
#pragma once

#include "camera.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

using Json = nlohmann::json;
using Scene = Json;
using Rgb = std::array<double, 3>;

/** Of volume files, and of the first size of pictures: nothing else is said. */
Scene scene_of_files(const std::vector<std::string>& files);

/** What stands under a key; an empty object where nothing does. */
const Json& part_of(const Json& whole, const char* key);

/** The value under a key; nothing where nothing stands there. */
template <class T> std::optional<T> said(const Json& part, const char* key) {
    const auto found = part.find(key);
    return found == part.end() ? std::nullopt : std::optional(found->template get<T>());
}

/** Puts it under the key, or nothing. */
template <class T> void say(Json& part, const char* key, const std::optional<T>& value) {
    if (value) {
        part[key] = *value;
    } else {
        part.erase(key);
    }
}

std::uint32_t time_step_of(const Scene& scene);
std::array<std::uint32_t, 2> size_of(const Scene& scene);
PictureSize picture_size(const Scene& scene);
/** What a picture of another size takes from one of this: in pixels, the shift of the camera grows with it. */
Scene resized(const Scene& scene, const std::array<std::uint32_t, 2>& size);

/** The words of an enumeration in the schema, at a JSON Pointer. */
std::vector<std::string> schema_words(const char* pointer);

/** Whether the scene says where its camera stands; otherwise it is placed so that the volume fills the picture. */
bool is_placed(const Scene& scene);

} // namespace elvis::view
