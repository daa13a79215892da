#include <core/session/surface_names.hpp>

#include <core/base/overloaded.hpp>

#include <cstdio>
#include <variant>

namespace elvis {

namespace {

std::string shape_name(const CutShape& shape) {
    return std::visit(
        Overloaded{[](const Sphere&) { return "sphere"; }, [](const Cylinder&) { return "cylinder"; },
                   [](const Cone&) { return "cone"; }, [](const Quadric&) { return "quadric"; },
                   [](const Torus&) { return "torus"; }, [](const ImplicitSurface&) { return "implicit surface"; },
                   [](const MeshSurface&) { return "mesh"; }, [](const BezierSurface&) { return "Bezier patches"; },
                   [](const TubeSurface&) { return "streamlines"; }, [](const RibbonSurface&) { return "ribbons"; },
                   [](const ArrowSurface&) { return "arrows"; }},
        shape);
}

std::string quoted(const std::string& name) { return " '" + name + "'"; }

/** Which of its kind it is. */
struct Detail {
    std::string operator()(const CutPlane& plane) const {
        const auto& [a, b, c, d] = plane.plane;
        char numbers[120];
        std::snprintf(numbers, sizeof numbers, " %.6g,%.6g,%.6g,%.6g", a, b, c, d);
        return numbers;
    }
    std::string operator()(const BoundaryFaces& boundary) const {
        std::string names;
        for (const std::string& group : boundary.groups) {
            names += quoted(group);
        }
        return names;
    }
    std::string operator()(const FlatElements&) const { return {}; }
    std::string operator()(const ElementFaces&) const { return {}; }
    std::string operator()(const WireFrame&) const { return {}; }
    std::string operator()(const CutShape&) const { return {}; }
    std::string operator()(const Isosurfaces&) const { return {}; }
};

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
    return kind_name(surface.geometry) + std::visit(Detail(), surface.geometry) +
           (surface.name.empty() ? std::string() : quoted(surface.name));
}

} // namespace elvis
