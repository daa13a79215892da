/**
 * @file shape.hpp
 * Cut surfaces other than planes, in world coordinates.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/surface/arrow_set.hpp>
#include <core/surface/patch_mesh.hpp>
#include <core/surface/ribbon_set.hpp>
#include <core/surface/triangle_mesh.hpp>
#include <core/surface/tube_set.hpp>

#include <array>
#include <memory>
#include <string>
#include <variant>

namespace elvis {

struct Sphere {
    Vector3 center{};
    double radius = 1; ///< > 0

    bool operator==(const Sphere&) const = default;
};

/** Round, from one end to the other. Without caps it is a pipe that is open at both ends. */
struct Cylinder {
    Vector3 from{}, to{}; ///< not equal
    double radius = 1;    ///< > 0
    bool is_capped = true;
};

/** As a cylinder, but with a radius at each end; at most one of them is zero. */
struct Cone {
    Vector3 from{}, to{};
    double from_radius = 0, to_radius = 1; ///< >= 0
    bool is_capped = true;
};

/** Where a xx + b yy + c zz + d xy + e yz + f zx + g x + h y + i z + j = 0; the coefficients a to i are not all zero. */
struct Quadric {
    std::array<double, 10> coefficients{};
};

struct Torus {
    Vector3 center{};
    Vector3 axis{0, 0, 1};   ///< of any length but zero
    double major_radius = 1; ///< from the centre to the tube's middle, > 0
    double minor_radius =
        1; ///< of the tube, > 0; more than the other one gives a spindle torus, whose inner part is drawn, too
};

/** Where a function of x, y and z changes its sign: an expression without fields (core/expression/expression.hpp). */
struct ImplicitSurface {
    std::string expression;
};

struct MeshSurface {
    std::shared_ptr<const TriangleMesh> mesh; ///< not null
};

struct BezierSurface {
    std::shared_ptr<const PatchMesh> mesh; ///< not null
};

struct TubeSurface {
    /** Null before its curves are known: then it can be read and written, not drawn. */
    std::shared_ptr<const TubeSet> tubes;
};

struct RibbonSurface {
    /** Null before its curves are known: then it can be read and written, not drawn. */
    std::shared_ptr<const RibbonSet> ribbons;
};

struct ArrowSurface {
    /** Null before they are known: then it can be read and written, not drawn. */
    std::shared_ptr<const ArrowSet> arrows;
};

using CutShape = std::variant<Sphere, Cylinder, Cone, Quadric, Torus, ImplicitSurface, MeshSurface, BezierSurface, TubeSurface,
                              RibbonSurface, ArrowSurface>;

/** Checks what the comments above ask for; throws Error that names `place` and the number. */
void check_shape(const CutShape& shape, const std::string& place);

} // namespace elvis
