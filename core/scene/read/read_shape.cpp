#include <core/scene/read/read_parts.hpp>

#include <algorithm>
#include <string_view>

namespace elvis {

namespace {

/** Keys that say where surfaces of some type lie, and those types. */
struct PlaceKey {
    const char* key;
    std::vector<std::string_view> types;
};

const std::vector<PlaceKey>& place_keys() {
    static const std::vector<PlaceKey> keys = {{"plane", {"plane"}},
                                               {"point", {"plane"}},
                                               {"normal", {"plane"}},
                                               {"groups", {"boundary", "wireframe"}},
                                               {"ids", {"elements", "wireframe"}},
                                               {"shapes", {"elements", "wireframe"}},
                                               {"orders", {"elements", "wireframe"}},
                                               {"negative_jacobian", {"elements", "wireframe"}},
                                               {"value_range", {"elements", "wireframe"}},
                                               {"box", {"elements", "wireframe"}},
                                               {"faces", {"elements", "wireframe"}},
                                               {"width", {"wireframe"}},
                                               {"color", {"wireframe", "isosurface", "streamlines", "pathlines", "arrows"}},
                                               {"values", {"isosurface"}},
                                               {"color_field", {"isosurface"}},
                                               {"range_skipping", {"isosurface"}},
                                               {"method", {"isosurface"}},
                                               {"degree", {"isosurface"}},
                                               {"center", {"sphere", "torus"}},
                                               {"radius", {"sphere", "cylinder", "streamlines", "pathlines"}},
                                               {"flow", {"streamlines", "pathlines"}},
                                               {"seeds", {"streamlines", "pathlines"}},
                                               {"seed_grid", {"streamlines", "pathlines"}},
                                               {"direction", {"streamlines", "pathlines"}},
                                               {"length", {"streamlines", "pathlines"}},
                                               {"tolerance", {"streamlines", "pathlines"}},
                                               {"start_time", {"pathlines"}},
                                               {"end_time", {"pathlines"}},
                                               {"interpolation", {"pathlines"}},
                                               {"vectors", {"arrows"}},
                                               {"on", {"arrows"}},
                                               {"spacing", {"arrows"}},
                                               {"scale", {"arrows"}},
                                               {"from", {"cylinder", "cone"}},
                                               {"to", {"cylinder", "cone"}},
                                               {"from_radius", {"cone"}},
                                               {"to_radius", {"cone"}},
                                               {"capped", {"cylinder", "cone"}},
                                               {"coefficients", {"quadric"}},
                                               {"axis", {"torus"}},
                                               {"major_radius", {"torus"}},
                                               {"minor_radius", {"torus"}},
                                               {"expression", {"implicit"}},
                                               {"file", {"mesh", "bezier"}},
                                               {"outside",
                                                {"plane", "sphere", "cylinder", "cone", "quadric", "torus", "implicit", "mesh",
                                                 "bezier", "streamlines", "pathlines"}}};
    return keys;
}

Vector3 vector(const JsonObject& object, const char* key) { return fixed<3>(object.numbers(key)); }

bool is_capped(const JsonObject& object) { return !object.has("capped") || object.flag("capped"); }

CutShape shape_of(const JsonObject& object, const std::string& type, const std::string& scene) {
    if (type == "sphere") {
        return Sphere{vector(object, "center"), object.number("radius")};
    }
    if (type == "cylinder") {
        return Cylinder{vector(object, "from"), vector(object, "to"), object.number("radius"), is_capped(object)};
    }
    if (type == "cone") {
        return Cone{vector(object, "from"), vector(object, "to"), object.number("from_radius"), object.number("to_radius"),
                    is_capped(object)};
    }
    if (type == "quadric") {
        return Quadric{fixed<10>(object.numbers("coefficients"))};
    }
    if (type == "implicit") {
        return ImplicitSurface{object.text("expression")};
    }
    if (type == "mesh") {
        return MeshSurface{std::make_shared<const TriangleMesh>(read_triangle_mesh(beside(scene, object.text("file"))))};
    }
    if (type == "bezier") {
        return BezierSurface{std::make_shared<const PatchMesh>(read_patch_mesh(beside(scene, object.text("file"))))};
    }
    return Torus{vector(object, "center"), vector(object, "axis"), object.number("major_radius"),
                 object.number("minor_radius")};
}

} // namespace

void check_place_keys(const JsonObject& object, const std::string& type) {
    for (const PlaceKey& key : place_keys()) {
        const bool is_its_own = std::find(key.types.begin(), key.types.end(), type) != key.types.end();
        if (object.has(key.key) && !is_its_own) {
            object.fail(key.key, "means nothing for a surface of type \"" + type + "\"");
        }
    }
}

CutShape read_shape(const JsonObject& object, const std::string& type, const std::string& scene) {
    for (const PlaceKey& key : place_keys()) {
        const bool is_its_own = std::find(key.types.begin(), key.types.end(), type) != key.types.end();
        const bool is_optional = key.key == std::string_view("capped") || key.key == std::string_view("outside");
        if (is_its_own && !object.has(key.key) && !is_optional) {
            object.fail(key.key, "is missing, which a surface of type \"" + type + "\" needs");
        }
    }
    CutShape shape = shape_of(object, type, scene);
    check_shape(shape, object.place());
    return shape;
}

} // namespace elvis
