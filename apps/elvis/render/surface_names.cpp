#include "surface_names.hpp"

#include <cstdio>
#include <type_traits>
#include <variant>

namespace elvis::commands {

namespace {

template <class... Functions> struct Overloaded : Functions... { using Functions::operator()...; };
template <class... Functions> Overloaded(Functions...) -> Overloaded<Functions...>;

std::string shape_name(const CutShape& shape) {
    return std::visit(
        Overloaded{[](const Sphere&) { return "sphere"; }, [](const Cylinder&) { return "cylinder"; },
                   [](const Cone&) { return "cone"; }, [](const Quadric&) { return "quadric"; },
                   [](const Torus&) { return "torus"; }, [](const ImplicitSurface&) { return "implicit surface"; },
                   [](const MeshSurface&) { return "mesh"; }, [](const BezierSurface&) { return "Bezier patches"; }},
        shape);
}

std::string quoted(const std::string& name) { return " '" + name + "'"; }

} // namespace

std::string kind_name(const SurfaceGeometry& geometry) {
    return std::visit(Overloaded{[](const CutPlane&) { return std::string("cut plane"); },
                                 [](const BoundaryFaces&) { return std::string("boundary"); },
                                 [](const FlatElements&) { return std::string("elements"); },
                                 [](const ElementFaces&) { return std::string("elements"); },
                                 [](const WireFrame&) { return std::string("wireframe"); },
                                 [](const CutShape& shape) { return shape_name(shape); },
                                 [](const Isosurfaces&) { return std::string("isosurface"); }},
                      geometry);
}

std::string surface_name(const SceneSurface& surface) {
    std::string text = kind_name(surface.geometry);
    if (const auto* plane = std::get_if<CutPlane>(&surface.geometry)) {
        const auto& [a, b, c, d] = plane->plane;
        char numbers[120];
        std::snprintf(numbers, sizeof numbers, " %.6g,%.6g,%.6g,%.6g", a, b, c, d);
        text += numbers;
    } else if (const auto* boundary = std::get_if<BoundaryFaces>(&surface.geometry)) {
        for (const std::string& group : boundary->groups) {
            text += quoted(group);
        }
    }
    return text + (surface.name.empty() ? std::string() : quoted(surface.name));
}

} // namespace elvis::commands
