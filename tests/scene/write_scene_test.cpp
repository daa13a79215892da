// Scenes as files: what is written is what was read, for every key that the schema knows.

#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/scene/scene.hpp>
#include <core/scene/write/write_scene.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>

using namespace elvis;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

namespace fs = std::filesystem;

class Folder : public TemporaryFolder {
public:
    Folder() {
        write("shape.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        std::string patch = "1\n3 3\n";
        for (int i = 0; i < 16; ++i) {
            patch += std::to_string(i / 4) + " " + std::to_string(i % 4) + " 0\n";
        }
        write("shape.bpt", patch);
    }
};

/** Scenes in the form in which they are written; together they hold every key. */
const std::vector<std::string>& documents() {
    static const std::vector<std::string> list = {
        R"json({"version": 1, "image": {"size": [1024, 768], "background": [1.0, 1.0, 1.0, 1.0]}})json",
        R"json({"version": 1,
            "volume": {"path": "data/ball.h5", "more_paths": ["data/ball.gf"], "plugin": "org.elvis.native", "options": {"a": [1, 2.5]}, "time_step": 3,
                       "joined": [{"name": "b", "path": "data/b.mesh", "more_paths": ["data/b.gf"], "plugin": "org.b", "options": {"c": 1}, "time_step": 2}, {"name": "before", "time_step": 0}]},
            "field": "norm(curl(u))", "precision": "float64", "memory": {"device": "2G", "host": "1536M"},
            "camera": {"type": "orthographic", "eye": [1.0, 2.0, 0.1], "look_at": [0.25, 0.0, 0.0], "up": [0.0, 0.0, 1.0],
                       "field_of_view": 33.3, "height": 4.5, "near": 0.125, "image_shift": [0.5, -0.25]},
            "image": {"size": [640, 480], "samples": 3, "background": [0.1, 0.2, 0.3, 0.4],
                      "annotation": {"title": "A title", "color_bars": false, "axes": true,
                                     "texts": [{"text": "here", "position": [0.1, 0.9], "anchor": [0.5, 0.5], "size": 0.05,
                                                "color": [1.0, 0.0, 0.0]}],
                                     "font": "font.ttf", "color": [0.0, 0.0, 1.0], "text_size": 0.03, "title_scale": 2.0,
                                     "axes_size": 0.1, "bar_side": "left", "bar_length": 0.5, "bar_width": 0.02}},
            "color_map": {"points": [[0.0, 0.0, 0.0, 0.0], [0.3, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0]], "space": "lab", "scale": "logarithmic",
                          "range": [0.5, 2.0], "below": [0.0, 0.0, 1.0], "above": [1.0, 0.0, 0.0], "nan": [0.0, 1.0, 0.0]},
            "contours": {"count": 7, "range": [0.0, 1.0], "width": 2.0, "color": [0.0, 0.0, 0.0],
                         "undecided_color": [1.0, 0.0, 1.0]},
            "mesh_lines": {"width": 1.5, "color": [0.5, 0.5, 0.5], "undecided_color": [1.0, 1.0, 0.0]},
            "lic": {"field": "u", "contrast": 0.5},
            "subdivisions": 8,
            "lighting": {"ambient": [0.2, 0.2, 0.2], "headlight": [0.5, 0.5, 1.5],
                         "lights": [{"type": "point", "position": [1.0, 2.0, 3.0], "color": [1.0, 1.0, 1.0]},
                                    {"type": "directional", "direction": [0.0, -1.0, 0.0], "color": [0.5, 0.5, 0.5],
                                     "visible": false}],
                         "specular": 0.4, "exponent": 12.0},
            "surfaces": [
              {"type": "plane", "plane": [1.0, 0.0, 0.0, -0.3], "name": "cut", "field": "p",
               "color_map": {"name": "coolwarm"}, "contours": {"values": [-1.0, 0.1], "width": 1.0},
               "mesh_lines": {"width": 1.0}, "lic": {"field": "grad(p)", "length": 30.0, "contrast": 0.25}, "clip": [[0.0, 1.0, 0.0, 0.5]], "opacity": 0.5, "outside": [0.9, 0.9, 0.9],
               "lighting": false, "visible": false},
              {"type": "boundary", "groups": ["wall", "inlet"]},
              {"type": "elements", "ids": [3, [5, 9]], "shapes": ["prism", "tetrahedron"], "orders": [2, 4],
               "negative_jacobian": true, "value_range": [0.0, 1.0], "box": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "faces": "outer"},
              {"type": "wireframe", "width": 2.0, "groups": ["wall"], "color": [0.0, 0.0, 0.0]},
              {"type": "wireframe", "width": 1.0, "orders": [1, 2], "faces": "inner", "color": [1.0, 0.0, 0.0], "lighting": true},
              {"type": "wireframe", "width": 1.0, "undeformed": true, "color": [0.5, 0.5, 0.5]},
              {"type": "sphere", "center": [0.0, 0.0, 0.0], "radius": 0.5},
              {"type": "cylinder", "from": [0.0, 0.0, 0.0], "to": [0.0, 0.0, 1.0], "radius": 0.5, "capped": false},
              {"type": "cone", "from": [0.0, 0.0, 0.0], "to": [0.0, 0.0, 1.0], "from_radius": 0.5, "to_radius": 0.0, "capped": true},
              {"type": "quadric", "coefficients": [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]},
              {"type": "torus", "center": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 1.0], "major_radius": 0.6, "minor_radius": 0.2},
              {"type": "implicit", "expression": "z - sin(x)"},
              {"type": "mesh", "file": "shape.obj"},
              {"type": "bezier", "file": "shape.bpt"},
              {"type": "isosurface", "values": [0.1, 0.2], "range_skipping": false, "method": "companion", "degree": 5,
               "color_field": "u[0]"},
              {"type": "isosurface", "values": [0.3], "color": [0.9, 0.5, 0.2]}],
            "volume_rendering": {"field": "waves^2", "color_map": {"file": "map.json"}, "opacity": [[0.0, 0.0], [1.0, 0.5]],
                                 "unit_distance": 0.25,
                                 "peaks": [{"value": 0.5, "width": 0.02, "density": 60.0, "color": [0.9, 0.9, 0.9]},
                                           {"value": 0.7, "width": 0.02, "density": 6.0}],
                                 "integrator": "categories", "step": 0.01, "range_skipping": false, "visible": false},
            "views": [{"name": "from the front", "camera": {"type": "perspective", "eye": [1.0, 2.0, 3.0]}}]})json",
        R"json({"version": 1, "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "volume_rendering": {"density": [[0.0, 0.0], [0.0, 2.0], [1.0, 4.0]], "integrator": "exact", "tolerance": 0.01}})json",
        R"json({"version": 1, "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "volume_rendering": {"transfer": {"color": [[0.0, 1.0, 0.0, 0.0]], "density": [[0.0, 0.0], [1.0, 2.0]]},
                                 "integrator": "exact", "tolerance": 0.001}})json",
        R"json({"version": 1, "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "volume_rendering": {"transfer": "transfer.json", "integrator": "exact", "tolerance": 0.001}})json",
        R"json({"version": 1, "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "animation": {"time_steps": "all", "turntable": {"frames": 12, "axis": [0.0, 0.0, 1.0], "degrees": -180.0},
                          "frames_a_second": 30.0}})json",
        R"json({"version": 1, "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "animation": {"time_steps": "8:2:3",
                          "key_frames": [{"frame": 0}, {"frame": 5, "eye": [1.0, 2.0, 3.0], "look_at": [0.0, 1.0, 0.0], "up": [0.0, 0.0, 1.0],
                                                        "field_of_view": 30.0, "height": 2.0}],
                          "frames_a_second": 25.0}})json",
        R"json({"version": 1, "volume": {"path": "a.h5"},
            "volumes": [{"time_step": 0, "offset": [1.0, 2.0, 3.0]}, {"offset": [0.0, 0.0, 0.0], "field": "p"},
                        {"path": "b.mesh", "more_paths": ["b.gf"], "plugin": "org.b", "options": {"c": 1}, "time_step": 4,
                         "offset": [0.0, 0.0, 1.0]}],
            "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]}})json",
        R"json({"version": 1, "warp": {"field": "u", "imaginary": "v", "factor": 2.5, "phase": 30.0}, "threshold": "p > 0.2 && x < y",
            "image": {"size": [10, 20], "background": [1.0, 1.0, 1.0, 1.0]},
            "surfaces": [
              {"type": "streamlines", "flow": "curl(u)", "seeds": [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]], "direction": "backward", "length": 3.0,
               "tolerance": 1e-6, "radius": 0.01, "color": [0.9, 0.5, 0.2]},
              {"type": "arrows", "vectors": "grad(p)", "on": "cut", "spacing": 0.25, "scale": 2.0, "field": "p", "opacity": 0.5},
              {"type": "streamlines", "flow": "u", "seed_grid": 7, "direction": "both", "tolerance": 1e-9, "ribbon_width": 0.05, "field": "p"},
              {"type": "streamlines", "flow": "u", "seed_line": [[0.0, 1.0, 2.0], [1.0, 1.0, 2.0]], "seed_count": 9, "direction": "both",
               "tolerance": 1e-9, "field": "p"},
              {"type": "streamlines", "flow": "u", "on": "cut", "spacing": 0.5, "direction": "both", "tolerance": 1e-9, "field": "p"},
              {"type": "pathlines", "flow": "u", "seed_grid": 3, "direction": "backward", "tolerance": 1e-9, "start_time": 2.5,
               "end_time": 0.5, "interpolation": "linear"},
              {"type": "pathlines", "flow": "u", "seeds": [[0.0, 1.0, 2.0]], "direction": "forward", "tolerance": 1e-9,
               "interpolation": "cubic", "color": [1.0, 0.0, 0.0]}],
            "animation": {"phases": 12, "frames_a_second": 25.0}})json"};
    return list;
}

/** Keys of objects at any depth, each with the key of the object that holds it. */
void collect_keys(const json& value, const std::string& owner, std::set<std::string>& keys) {
    if (!value.is_structured()) {
        return;
    }
    for (const auto& [key, child] : value.items()) {
        if (value.is_object()) {
            keys.insert(owner + "." + key);
        }
        collect_keys(child, value.is_object() ? key : owner, keys);
    }
}

/** The same, of what a schema allows. */
void collect_allowed(const json& schema, const json& root, const std::string& owner, std::set<std::string>& keys) {
    if (const auto reference = schema.find("$ref"); reference != schema.end()) {
        collect_allowed(root.at(json::json_pointer(reference->get<std::string>().substr(1))), root, owner, keys);
        return;
    }
    for (const json& alternative : schema.value("anyOf", json::array())) {
        collect_allowed(alternative, root, owner, keys);
    }
    if (const auto items = schema.find("items"); items != schema.end()) {
        collect_allowed(*items, root, owner, keys);
    }
    const json properties = schema.value("properties", json::object());
    for (const auto& [key, child] : properties.items()) {
        keys.insert(owner + "." + key);
        collect_allowed(child, root, key, keys);
    }
}

} // namespace

TEST_CASE("A scene that was written reads as it was") {
    const Folder folder;
    for (const std::string& document : documents()) {
        const ordered_json expected = ordered_json::parse(document);
        const Scene scene = read_scene(folder.write("scene.json", expected.dump()));
        CHECK(scene_json(scene, folder.path("scene.json")).dump(1) == expected.dump(1));
        write_scene(scene, folder.path("written.json"));
        const Scene again = read_scene(folder.path("written.json"));
        CHECK(scene_json(again, folder.path("scene.json")).dump(1) == expected.dump(1));
    }
}

TEST_CASE("Lines of which nothing is said are written") {
    const json lines = {{"contours", json::object()}, {"mesh_lines", {{"width", 1.0}}}};
    json document = lines;
    document["version"] = 1;
    document["surfaces"] = json::array({lines});
    document["surfaces"][0].update({{"type", "boundary"}, {"contours", {{"count", 5}}}});
    const json written = json::parse(scene_json(scene_of(document, "scene.json"), "scene.json").dump());
    CHECK(written["contours"] == lines["contours"]);
    CHECK(written["mesh_lines"] == lines["mesh_lines"]);
    CHECK(written["surfaces"] == document["surfaces"]);
}

TEST_CASE("Every key of the schema is written") {
    const Folder folder;
    std::set<std::string> written, allowed;
    for (const std::string& document : documents()) {
        const Scene scene = read_scene(folder.write("scene.json", document));
        collect_keys(json::parse(scene_json(scene, folder.path("scene.json")).dump()), "", written);
    }
    const json schema = json::parse(scene_schema_text());
    collect_allowed(schema, schema, "", allowed);
    // Other words for what is written: planes by point and normal, isosurfaces among the surfaces.
    allowed.erase("surfaces.point");
    allowed.erase("surfaces.normal");
    std::erase_if(allowed, [](const std::string& key) { return key == ".isosurfaces" || key.starts_with("isosurfaces."); });
    for (const std::string& key : allowed) {
        INFO(key);
        CHECK(written.count(key) == 1);
    }
}

TEST_CASE("A scene that is written elsewhere speaks of the same files") {
    const Folder folder;
    const Scene scene = read_scene(folder.write("scene.json", R"({"version": 1, "volume": {"path": "data/ball.h5"}})"));
    fs::create_directories(folder.path("below/deeper"));
    const std::string other = folder.path("below/deeper/scene.json");
    write_scene(scene, other);
    CHECK(fs::weakly_canonical(read_scene(other).volume) == fs::weakly_canonical(folder.path("data/ball.h5")));
    CHECK(scene_json(scene, other)["volume"]["path"] == "../../data/ball.h5");
}

TEST_CASE("A scene that cannot be written is an error that names the file") {
    CHECK_THROWS_WITH(write_scene(Scene{}, "/no/such/folder/scene.json"),
                      Catch::Matchers::Contains("/no/such/folder/scene.json"));
}
