#include <core/scene/write/write_scene.hpp>

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/scene/write/write_parts.hpp>

#include <filesystem>

namespace elvis {

namespace {

SceneJson camera_json(const SceneCamera& camera) {
    SceneJson json = SceneJson::object();
    if (camera.orthographic) {
        json["type"] = *camera.orthographic ? "orthographic" : "perspective";
    }
    set(json, "eye", camera.eye);
    set(json, "look_at", camera.look_at);
    set(json, "up", camera.up);
    set(json, "field_of_view", camera.field_of_view);
    set(json, "height", camera.height);
    set(json, "near", camera.near);
    if (camera.image_shift != std::array<double, 2>{}) {
        json["image_shift"] = camera.image_shift;
    }
    return json;
}

SceneJson files_json(const std::string& file, const std::vector<std::string>& more_files, const std::string& plugin,
                     const std::string& options, const std::string& path) {
    SceneJson json;
    json["path"] = seen_from(path, file);
    for (const std::string& more : more_files) {
        json["more_paths"].push_back(seen_from(path, more));
    }
    if (!plugin.empty()) {
        json["plugin"] = plugin;
    }
    if (!options.empty()) {
        json["options"] = SceneJson::parse(options);
    }
    return json;
}

SceneJson join_json(const SceneJoin& join, const std::string& path) {
    SceneJson json = SceneJson::object();
    json["name"] = join.name;
    if (!join.path.empty()) {
        json.update(files_json(join.path, join.more_files, join.plugin, join.plugin_options, path));
    }
    set(json, "time_step", join.time_step);
    return json;
}

SceneJson further_volume_json(const SceneVolume& volume, const std::string& path) {
    SceneJson json = SceneJson::object();
    if (!volume.path.empty()) {
        json = files_json(volume.path, volume.more_files, volume.plugin, volume.plugin_options, path);
    }
    set(json, "time_step", volume.time_step);
    json["offset"] = volume.offset;
    set(json, "field", volume.field);
    return json;
}

SceneJson volume_json(const Scene& scene, const std::string& path) {
    SceneJson json = files_json(scene.volume, scene.more_files, scene.plugin, scene.plugin_options, path);
    if (scene.time_step != 0) {
        json["time_step"] = scene.time_step;
    }
    for (const SceneJoin& join : scene.joined) {
        json["joined"].push_back(join_json(join, path));
    }
    return json;
}

SceneJson warp_json(const SceneWarp& warp) {
    SceneJson json;
    json["field"] = warp.field;
    set(json, "imaginary", warp.imaginary);
    json["factor"] = warp.factor;
    if (warp.phase != 0) {
        json["phase"] = warp.phase;
    }
    return json;
}

SceneJson memory_json(const MemoryBudget& memory) {
    SceneJson json = SceneJson::object();
    if (memory.device) {
        json["device"] = size_text(*memory.device);
    }
    if (memory.host) {
        json["host"] = size_text(*memory.host);
    }
    return json;
}

SceneJson image_json(const Scene& scene, const std::string& path) {
    SceneJson json;
    json["size"] = scene.size;
    if (scene.samples > 1) {
        json["samples"] = scene.samples;
    }
    json["background"] = scene.background;
    if (scene.annotation) {
        json["annotation"] = annotation_json(*scene.annotation, path);
    }
    return json;
}

} // namespace

std::string seen_from(const std::string& scene, const std::string& path) {
    namespace fs = std::filesystem;
    // Folders without symbolic links, so that ".." means the same to everyone.
    const auto real = [](const fs::path& file) {
        const fs::path whole = fs::absolute(file).lexically_normal();
        std::error_code error;
        const fs::path folder = fs::weakly_canonical(whole.parent_path(), error);
        return error ? whole : folder / whole.filename();
    };
    const fs::path relative = real(path).lexically_relative(real(scene).parent_path());
    return relative.empty() ? real(path).string() : relative.string();
}

SceneJson scene_json(const Scene& scene, const std::string& path) {
    SceneJson json;
    json["version"] = 1;
    if (!scene.volume.empty()) {
        json["volume"] = volume_json(scene, path);
    }
    for (const SceneVolume& volume : scene.volumes) {
        json["volumes"].push_back(further_volume_json(volume, path));
    }
    if (scene.warp) {
        json["warp"] = warp_json(*scene.warp);
    }
    set(json, "field", scene.field);
    set(json, "threshold", scene.threshold);
    if (scene.precision) {
        json["precision"] = name_of(*scene.precision);
    }
    if (scene.memory) {
        json["memory"] = memory_json(*scene.memory);
    }
    if (const SceneJson camera = camera_json(scene.camera); !camera.empty()) {
        json["camera"] = camera;
    }
    json["image"] = image_json(scene, path);
    if (const SceneJson map = color_map_json(scene.color_map, path); !map.empty()) {
        json["color_map"] = map;
    }
    if (scene.contours) {
        json["contours"] = contours_json(*scene.contours);
    }
    if (scene.mesh_lines) {
        json["mesh_lines"] = line_style_json(*scene.mesh_lines);
    }
    if (scene.lic) {
        json["lic"] = lic_json(*scene.lic);
    }
    if (scene.subdivisions != Scene{}.subdivisions) {
        json["subdivisions"] = scene.subdivisions;
    }
    if (scene.lighting) {
        json["lighting"] = lighting_json(*scene.lighting, scene.hidden_lights);
    }
    for (const SceneSurface& surface : scene.surfaces) {
        json["surfaces"].push_back(surface_json(surface, path));
    }
    if (scene.volume_rendering) {
        json["volume_rendering"] = volume_rendering_json(*scene.volume_rendering, path);
    }
    if (scene.animation) {
        json["animation"] = animation_json(*scene.animation);
    }
    for (const SceneView& view : scene.views) {
        json["views"].push_back({{"name", view.name}, {"camera", camera_json(view.camera)}});
    }
    return json;
}

void write_scene(const Scene& scene, const std::string& path) { write_text_file(path, scene_json(scene, path).dump(2) + "\n"); }

} // namespace elvis
