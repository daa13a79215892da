#include <core/base/error.hpp>
#include <core/scene/json_reader.hpp>
#include <core/scene/scene.hpp>

#include <scene_schema.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace elvis {

namespace {

template <std::size_t N> std::array<double, N> fixed(const std::vector<double>& list) {
    std::array<double, N> result{};
    std::copy_n(list.begin(), N, result.begin());
    return result;
}

/** A path of the scene, seen from the working directory. */
std::string beside(const std::string& scene, const std::string& path) {
    return (std::filesystem::path(scene).parent_path() / path).string();
}

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
    if (object.has("image_shift")) {
        camera.image_shift = fixed<2>(object.numbers("image_shift"));
    }
    return camera;
}

SceneColorMap read_color_map(const JsonObject& object, const std::string& scene) {
    SceneColorMap map;
    if (object.has("name") + object.has("file") + object.has("points") > 1) {
        object.fail("name", "stands beside 'file' or 'points'; give one of them");
    }
    if (object.has("name")) {
        map.name = object.text("name");
    }
    if (object.has("file")) {
        map.file = beside(scene, object.text("file"));
    }
    if (object.has("points")) {
        for (const std::vector<double>& row : object.rows("points")) {
            if (!map.points.empty() && row[0] < map.points.back().position) {
                object.fail("points", "must have ascending positions");
            }
            map.points.push_back({row[0], {row[1], row[2], row[3]}});
        }
    }
    if (object.has("space")) {
        const std::string space = object.word("space");
        map.space = space == "lab"         ? ColorSpace::lab
                    : space == "hsv"       ? ColorSpace::hsv
                    : space == "diverging" ? ColorSpace::diverging
                    : space == "step"      ? ColorSpace::step
                                           : ColorSpace::rgb;
    }
    if (object.has("range")) {
        map.range = fixed<2>(object.numbers("range"));
        if (!((*map.range)[0] < (*map.range)[1])) {
            object.fail("range", "must go from a smaller to a larger value");
        }
    }
    if (object.has("below")) {
        map.below = fixed<3>(object.numbers("below"));
    }
    if (object.has("above")) {
        map.above = fixed<3>(object.numbers("above"));
    }
    if (object.has("nan")) {
        map.nan = fixed<3>(object.numbers("nan"));
    }
    return map;
}

void refuse_keys(const JsonObject& surface, const std::string& type, std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
        if (surface.has(key)) {
            surface.fail(key, "means nothing for a surface of type \"" + type + "\"");
        }
    }
}

std::vector<std::string> read_boundary(const JsonObject& object) {
    refuse_keys(object, "boundary", {"plane", "point", "normal"});
    return object.has("groups") ? object.texts("groups") : std::vector<std::string>();
}

CutPlane read_plane(const JsonObject& object) {
    refuse_keys(object, "plane", {"groups"});
    CutPlane plane;
    if (object.has("plane") == (object.has("point") || object.has("normal"))) {
        object.fail("plane", "or 'point' and 'normal' must say where the plane is, and only one of the two");
    }
    if (object.has("plane")) {
        plane.plane = fixed<4>(object.numbers("plane"));
    } else {
        if (!object.has("point") || !object.has("normal")) {
            object.fail("point", "and 'normal' belong together");
        }
        const auto point = fixed<3>(object.numbers("point"));
        const auto normal = fixed<3>(object.numbers("normal"));
        plane.plane = {normal[0], normal[1], normal[2], -(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2])};
    }
    if (plane.plane[0] == 0 && plane.plane[1] == 0 && plane.plane[2] == 0) {
        object.fail("plane", "has a normal of length zero");
    }
    return plane;
}

} // namespace

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

Scene read_scene(const std::string& path) {
    static const nlohmann::json schema = nlohmann::json::parse(scene_schema_text());
    const nlohmann::json document = parse_json_file(path);
    const JsonObject root(document, schema, path, "");
    root.integer("version");
    Scene scene;
    if (root.has("volume")) {
        const JsonObject volume = root.object("volume");
        scene.volume = beside(path, volume.text("path"));
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
    if (root.has("field")) {
        scene.field = root.text("field");
    }
    if (root.has("precision")) {
        scene.precision = root.word("precision");
    }
    if (root.has("camera")) {
        scene.camera = read_camera(root.object("camera"));
    }
    if (root.has("image")) {
        const JsonObject image = root.object("image");
        if (image.has("size")) {
            const std::vector<double> size = image.numbers("size");
            scene.size = {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1])};
        }
        if (image.has("background")) {
            const std::vector<double> color = image.numbers("background");
            std::copy(color.begin(), color.end(), scene.background.begin());
        }
    }
    if (root.has("color_map")) {
        scene.color_map = read_color_map(root.object("color_map"), path);
    }
    if (root.has("surfaces")) {
        for (const JsonObject& surface : root.objects("surfaces")) {
            if (surface.word("type") == "plane") {
                scene.cut_planes.push_back(read_plane(surface));
            } else if (scene.boundary) {
                surface.fail("type", "is \"boundary\" a second time; name all groups in one");
            } else {
                scene.boundary = read_boundary(surface);
            }
        }
    }
    return scene;
}

} // namespace elvis
