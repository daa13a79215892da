#include <core/scene/read/read_parts.hpp>

namespace elvis {

namespace {

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

CutShape read_shape(const JsonObject& object, const std::string& type, const std::string& scene) {
    CutShape shape = shape_of(object, type, scene);
    check_shape(shape, object.place());
    return shape;
}

} // namespace elvis
