/**
 * @file write_scene.hpp
 * Scenes as files: the inverse of read_scene.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace elvis {

/** What the file at `path` would hold. Paths of other files become relative to its folder. */
nlohmann::ordered_json scene_json(const Scene& scene, const std::string& path);

/** Reading the file gives the same scene again. Appears whole or not at all. Throws Error naming the file. */
void write_scene(const Scene& scene, const std::string& path);

} // namespace elvis
