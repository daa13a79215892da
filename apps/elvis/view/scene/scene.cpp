#include "scene.hpp"

#include <elvis/elvis.h>

#include <algorithm>

namespace elvis::view {

Scene scene_of_files(const std::vector<std::string>& files) {
    Scene scene{{"version", 1}, {"image", {{"size", {1024, 768}}}}};
    if (!files.empty()) {
        scene["volume"]["path"] = files.front();
    }
    if (files.size() > 1) {
        scene["volume"]["more_paths"] = std::vector<std::string>(files.begin() + 1, files.end());
    }
    return scene;
}

const Json& part_of(const Json& whole, const char* key) {
    static const Json none = Json::object();
    const auto found = whole.find(key);
    return found == whole.end() ? none : *found;
}

std::uint32_t time_step_of(const Scene& scene) { return part_of(scene, "volume").value("time_step", 0u); }

std::array<std::uint32_t, 2> size_of(const Scene& scene) { return scene.at("image").at("size"); }

PictureSize picture_size(const Scene& scene) {
    const auto [width, height] = size_of(scene);
    return {static_cast<double>(width), static_cast<double>(height)};
}

Scene resized(const Scene& scene, const std::array<std::uint32_t, 2>& size) {
    Scene result = scene;
    result["image"]["size"] = size;
    if (auto shift = said<std::array<double, 2>>(part_of(scene, "camera"), "image_shift")) {
        for (double& pixels : *shift) {
            pixels *= static_cast<double>(size[1]) / size_of(scene)[1];
        }
        result["camera"]["image_shift"] = *shift;
    }
    return result;
}

std::vector<std::string> schema_words(const char* pointer) {
    static const Json schema = Json::parse(elvis_scene_schema());
    return schema.at(Json::json_pointer(pointer));
}

bool is_placed(const Scene& scene) {
    const Json& camera = part_of(scene, "camera");
    const auto has = [&](const char* key) { return camera.contains(key); };
    return has("eye") || has("look_at") || has("height") ||
           camera.value("image_shift", std::array<double, 2>{}) != std::array<double, 2>{};
}

} // namespace elvis::view
