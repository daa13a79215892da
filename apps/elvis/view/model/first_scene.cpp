#include "first_scene.hpp"

#include <core/scene/write/write_scene.hpp>

#include <nlohmann/json.hpp>

namespace elvis::view {

Scene first_scene(const context& library, const data& volume, const std::string& path) {
    /** A file that is not there: paths of scenes are seen from the working directory. */
    constexpr const char* no_file = "scene";
    Scene scene;
    scene.volume = path;
    scene.annotation = SceneAnnotation{};
    if (volume.info().dimension == 3 && nlohmann::json::parse(volume.describe_briefly())["n_faces"] > 0) {
        scene.lighting = Lighting{};
    }
    const elvis::scene complete = library.parse_scene(scene_json(scene, no_file).dump()).completed(volume);
    scene.surfaces = scene_of(nlohmann::json::parse(complete.json()), no_file).surfaces;
    return scene;
}

} // namespace elvis::view
