#include <core/arrows/shape_candidates.hpp>

#include <core/base/overloaded.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace elvis {

namespace {

/** Radii and heights. */
using RingCurve = std::vector<std::array<double, 2>>;

void add_straight(const std::array<double, 2>& from, const std::array<double, 2>& to, double step, RingCurve& curve) {
    const double n = std::max(1.0, std::ceil(std::hypot(to[0] - from[0], to[1] - from[1]) / step));
    need_few(n);
    for (double i = 0; i <= n; ++i) {
        curve.push_back({from[0] + i / n * (to[0] - from[0]), from[1] + i / n * (to[1] - from[1])});
    }
}

/** About a point at that distance from the axis, from one angle above the plane across it to another. */
RingCurve arc(double distance, double radius, double from, double to, double step) {
    const double n = std::max(1.0, std::ceil(radius * (to - from) / step));
    need_few(n);
    RingCurve curve;
    for (double i = 0; i <= n; ++i) {
        const double angle = from + i / n * (to - from);
        curve.push_back({std::abs(distance + radius * std::cos(angle)), radius * std::sin(angle)});
    }
    return curve;
}

void add_cone(const Cone& cone, Candidates& candidates) {
    const Vector3 axis = minus(cone.to, cone.from);
    const double height = length(axis), step = candidates.step();
    RingCurve curve;
    add_straight({cone.from_radius, 0}, {cone.to_radius, height}, step, curve);
    if (cone.is_capped) {
        add_straight({0, 0}, {cone.from_radius, 0}, step, curve);
        add_straight({0, height}, {cone.to_radius, height}, step, curve);
    }
    candidates.add_rings(cone.from, unit(axis), curve);
}

/** n + 1 points a direction, so many that none is farther from the next than the step along the net of control points. */
void add_patch(const BezierPatch& patch, Candidates& candidates) {
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        double along = 0, across = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            along += length(minus(patch.points[4 * i + j + 1], patch.points[4 * i + j]));
            across += length(minus(patch.points[4 * (j + 1) + i], patch.points[4 * j + i]));
        }
        longest = std::max({longest, along, across});
    }
    const double n = std::max(1.0, std::ceil(longest / candidates.step()));
    need_few(n * n);
    for (double i = 0; i <= n; ++i) {
        for (double j = 0; j <= n; ++j) {
            candidates.add(patch.at(i / n, j / n));
        }
    }
}

void add_piece(const RibbonSet::Piece& piece, Candidates& candidates) {
    const auto& [a, b, c, d] = piece;
    const double longest = std::max({length(minus(b, a)), length(minus(d, c)), length(minus(c, a)), length(minus(d, b))});
    const double n = std::max(1.0, std::ceil(longest / candidates.step()));
    need_few(n * n);
    for (const std::vector<double>& weights : lattice_of_face(4, static_cast<int>(n))) {
        candidates.add(weighted({a, b, d, c}, weights));
    }
}

} // namespace

bool add_shape(const CutShape& shape, Candidates& candidates) {
    constexpr double pi = std::numbers::pi;
    const double step = candidates.step();
    return std::visit(
        Overloaded{[&](const Sphere& sphere) {
                       candidates.add_rings(sphere.center, {0, 0, 1}, arc(0, sphere.radius, -0.5 * pi, 0.5 * pi, step));
                       return true;
                   },
                   [&](const Torus& torus) {
                       candidates.add_rings(torus.center, unit(torus.axis),
                                            arc(torus.major_radius, torus.minor_radius, 0, 2 * pi, step));
                       return true;
                   },
                   [&](const Cone& cone) {
                       add_cone(cone, candidates);
                       return true;
                   },
                   [&](const Cylinder& pipe) {
                       add_cone({pipe.from, pipe.to, pipe.radius, pipe.radius, pipe.is_capped}, candidates);
                       return true;
                   },
                   [&](const MeshSurface& surface) {
                       const TriangleMesh& mesh = *surface.mesh;
                       for (const auto& [a, b, c] : mesh.triangles) {
                           candidates.add_triangle({mesh.points[a], mesh.points[b], mesh.points[c]});
                       }
                       return true;
                   },
                   [&](const BezierSurface& surface) {
                       for (const BezierPatch& patch : surface.mesh->patches) {
                           add_patch(patch, candidates);
                       }
                       return true;
                   },
                   [&](const RibbonSurface& surface) {
                       if (!surface.ribbons) {
                           return false;
                       }
                       for (const RibbonSet::Piece& piece : surface.ribbons->pieces) {
                           add_piece(piece, candidates);
                       }
                       return true;
                   },
                   [](const auto&) { return false; }},
        shape);
}

std::optional<std::string> level_of(const CutShape& shape) {
    if (const auto* const implicit = std::get_if<ImplicitSurface>(&shape)) {
        return implicit->expression;
    }
    const auto* const quadric = std::get_if<Quadric>(&shape);
    if (quadric == nullptr) {
        return std::nullopt;
    }
    constexpr std::array<const char*, 10> terms = {"@x^2", "@y^2", "@z^2", "@x*@y", "@y*@z", "@z*@x", "@x", "@y", "@z", "1"};
    std::string sum = "0";
    for (std::size_t i = 0; i < terms.size(); ++i) {
        std::array<char, 64> term{};
        std::snprintf(term.data(), term.size(), "+(%.17g)*%s", quadric->coefficients[i], terms[i]);
        sum += term.data();
    }
    return sum;
}

} // namespace elvis
