#include <core/base/error.hpp>
#include <core/scene/read/json_reader.hpp>
#include <core/scene/read/read_parts.hpp>
#include <core/scene/scene.hpp>

#include <scene_schema.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace elvis {

namespace {

SceneCamera read_camera(const JsonObject& object) {
    SceneCamera camera;
    if (object.has("type")) {
        camera.orthographic = object.word("type") == "orthographic";
    }
    if (object.has("eye")) {
        camera.eye = fixed<3>(object.numbers("eye"));
    }
    if (object.has("look_at")) {
        camera.look_at = fixed<3>(object.numbers("look_at"));
    }
    if (object.has("up")) {
        camera.up = fixed<3>(object.numbers("up"));
    }
    if (object.has("field_of_view")) {
        camera.field_of_view = object.number("field_of_view");
    }
    if (object.has("height")) {
        camera.height = object.number("height");
    }
    if (object.has("near")) {
        camera.near = object.number("near");
    }
    if (object.has("image_shift")) {
        camera.image_shift = fixed<2>(object.numbers("image_shift"));
    }
    return camera;
}

void read_volume(const JsonObject& volume, const std::string& path, Scene& scene) {
    scene.volume = beside(path, volume.text("path"));
    if (volume.has("more_paths")) {
        for (const std::string& more : volume.texts("more_paths")) {
            scene.more_files.push_back(beside(path, more));
        }
    }
    if (volume.has("plugin")) {
        scene.plugin = volume.text("plugin");
    }
    if (volume.has("options")) {
        scene.plugin_options = volume.raw("options").dump();
    }
    if (volume.has("time_step")) {
        scene.time_step = volume.integer("time_step");
    }
}

/** The keys of files, if they are there. `Files`: SceneVolume or SceneJoin. */
template <class Files> void read_files(const JsonObject& object, const std::string& path, Files& wanted) {
    if (object.has("path")) {
        Scene files;
        read_volume(object, path, files);
        wanted.path = files.volume;
        wanted.more_files = files.more_files;
        wanted.plugin = files.plugin;
        wanted.plugin_options = files.plugin_options;
    }
    for (const char* const key : {"more_paths", "plugin", "options"}) {
        if (object.has(key) && wanted.path.empty()) {
            object.fail(key, "goes with 'path', which is missing");
        }
    }
    if (object.has("time_step")) {
        wanted.time_step = object.integer("time_step");
    }
}

SceneJoin read_join(const JsonObject& object, const std::string& path) {
    SceneJoin join;
    join.name = object.text("name");
    read_files(object, path, join);
    return join;
}

SceneVolume read_further_volume(const JsonObject& object, const std::string& path) {
    SceneVolume volume;
    read_files(object, path, volume);
    if (object.has("offset")) {
        volume.offset = fixed<3>(object.numbers("offset"));
    }
    if (object.has("field")) {
        volume.field = object.text("field");
    }
    return volume;
}

SceneWarp read_warp(const JsonObject& object) {
    SceneWarp warp;
    if (!object.has("field")) {
        object.fail("field", "is missing: it names the displacement");
    }
    warp.field = object.text("field");
    if (object.has("imaginary")) {
        warp.imaginary = object.text("imaginary");
    }
    if (object.has("factor")) {
        warp.factor = object.number("factor");
    }
    if (object.has("phase")) {
        warp.phase = object.number("phase");
    }
    return warp;
}

std::optional<std::uint64_t> read_size(const JsonObject& memory, const char* key) {
    if (!memory.has(key)) {
        return {};
    }
    const std::string text = memory.text(key);
    const std::optional<std::uint64_t> bytes = bytes_of_size(text);
    if (!bytes) {
        memory.fail(key, no_size_text(text));
    }
    return bytes;
}

void read_image(const JsonObject& image, const std::string& path, Scene& scene) {
    if (image.has("size")) {
        const std::vector<double> size = image.numbers("size");
        scene.size = {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1])};
    }
    if (image.has("samples")) {
        scene.samples = static_cast<std::uint32_t>(image.number("samples"));
    }
    if (image.has("background")) {
        const std::vector<double> color = image.numbers("background");
        std::copy(color.begin(), color.end(), scene.background.begin());
    }
    if (image.has("annotation")) {
        scene.annotation = read_annotation(image, path);
    }
}

} // namespace

/** A path of the scene, seen from the working directory. */
std::string beside(const std::string& scene, const std::string& path) {
    return (std::filesystem::path(scene).parent_path() / path).string();
}

std::string_view scene_schema_text() { return scene_schema::files[0].text; }

bool is_scene(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(65536, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    const bool is_json = first != std::string::npos && head[first] == '{';
    return is_json && (head.find("\"version\"") != std::string::npos || head.find("\"volume\"") != std::string::npos);
}

Scene read_scene(const std::string& path) { return scene_of(parse_json_file(path), path); }

Scene scene_of(const nlohmann::json& document, const std::string& path) {
    static const nlohmann::json schema = nlohmann::json::parse(scene_schema_text());
    const JsonObject root(document, schema, path, "");
    root.integer("version");
    Scene scene;
    if (root.has("volume")) {
        const JsonObject volume = root.object("volume");
        read_volume(volume, path, scene);
        for (const JsonObject& join : volume.has("joined") ? volume.objects("joined") : std::vector<JsonObject>()) {
            scene.joined.push_back(read_join(join, path));
        }
    }
    if (root.has("volumes")) {
        for (const JsonObject& volume : root.objects("volumes")) {
            scene.volumes.push_back(read_further_volume(volume, path));
        }
    }
    if (root.has("warp")) {
        scene.warp = read_warp(root.object("warp"));
    }
    if (root.has("field")) {
        scene.field = root.text("field");
    }
    if (root.has("threshold")) {
        scene.threshold = root.text("threshold");
    }
    if (root.has("precision")) {
        scene.precision = precision_named(root.word("precision"));
    }
    if (root.has("memory")) {
        const JsonObject memory = root.object("memory");
        scene.memory = {read_size(memory, "device"), read_size(memory, "host")};
    }
    if (root.has("camera")) {
        scene.camera = read_camera(root.object("camera"));
    }
    if (root.has("views")) {
        for (const JsonObject& view : root.objects("views")) {
            scene.views.push_back({view.text("name"), read_camera(view.object("camera"))});
        }
    }
    if (root.has("image")) {
        read_image(root.object("image"), path, scene);
    }
    if (root.has("color_map")) {
        scene.color_map = read_color_map(root.object("color_map"), path);
    }
    if (root.has("contours")) {
        scene.contours = read_contours(root.object("contours"));
    }
    if (root.has("mesh_lines")) {
        scene.mesh_lines = read_line_style(root.object("mesh_lines"));
    }
    if (root.has("lic")) {
        scene.lic = read_lic(root.object("lic"));
    }
    if (root.has("subdivisions")) {
        scene.subdivisions = root.integer("subdivisions");
    }
    if (root.has("lighting")) {
        scene.lighting = read_lighting(root, scene.hidden_lights);
    }
    if (root.has("surfaces")) {
        for (const JsonObject& surface : root.objects("surfaces")) {
            scene.surfaces.push_back(read_surface(surface, surface.word("type"), path));
        }
    }
    if (root.has("isosurfaces")) {
        for (const JsonObject& surface : root.objects("isosurfaces")) {
            scene.surfaces.push_back(read_surface(surface, "isosurface", path));
        }
    }
    if (root.has("volume_rendering")) {
        scene.volume_rendering = read_volume_rendering(root.object("volume_rendering"), path);
    }
    if (root.has("animation")) {
        scene.animation = read_animation(root.object("animation"));
        if (scene.animation->n_phases > 0 && !scene.warp) {
            root.object("animation").fail("phases", "are those of the warp, which the scene does not have");
        }
    }
    return scene;
}

} // namespace elvis
