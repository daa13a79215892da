#include "domain.hpp"

#include <cmath>
#include <numbers>

namespace generator {
namespace {

using std::numbers::pi;

// Half the edge of the cube (or square) in the middle of a ball (or tube), over the radius. Its corners reach 0.78 (0.64) of
// the radius, which leaves room for well-shaped layers.
constexpr double core_extent = 0.45;

Vec3 in_box(const Parameters& p, const Vec3& u) {
    Vec3 x;
    for (std::size_t d = 0; d < 3; ++d)
        x[d] = p.box[0][d] * (1 - u[d]) + p.box[1][d] * u[d];
    return x;
}

Vec3 waves(const Parameters& p, const Vec3& u) {
    const Vec3 q = in_box(p, u);
    const auto s = [&](std::size_t d) { return std::sin(pi * q[d]); };
    const auto c = [&](std::size_t d) { return std::cos(pi * q[d]); };
    return {q[0] + p.amplitude * s(1) * c(2), q[1] + p.amplitude * s(2) * c(0), q[2] + p.amplitude * s(0) * c(1)};
}

// From the point of the inner square or cube (n coordinates in [-1,1]) to the circle or sphere of radius 1, blended by t.
// On the rim, angles are equidistant along each side (the equiangular gnomonic projection).
template <std::size_t n> std::array<double, n> blend(const std::array<double, n>& v, double inner, double t) {
    std::array<double, n> rim;
    double norm = 0;
    for (std::size_t d = 0; d < n; ++d) {
        rim[d] = std::tan(0.25 * pi * v[d]);
        norm += rim[d] * rim[d];
    }
    norm = std::sqrt(norm);
    std::array<double, n> x;
    for (std::size_t d = 0; d < n; ++d)
        x[d] = (1 - t) * inner * v[d] + (t == 0 ? 0 : t * rim[d] / norm);
    return x;
}

Vec3 symmetric(const Vec3& u) { return {2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1}; }

Vec3 scaled(const Vec3& x, double factor) { return {factor * x[0], factor * x[1], factor * x[2]}; }

Vec3 torus(const Parameters& p, const LatticePoint& point) {
    const auto disc = blend<2>({2 * point.u[0] - 1, 2 * point.u[1] - 1}, core_extent, point.t);
    // Clockwise seen from above, so that (u1, u2, u3) is right-handed.
    const double angle = -2 * pi * point.u[2];
    const double distance = p.radius + p.tube_radius * disc[0];
    return {distance * std::cos(angle), distance * std::sin(angle), p.tube_radius * disc[1]};
}

// The mid-edge node (0.5, 0, 0) moved to (0.5, 0, 0.6): the quadratic function 4 (1 - x - y - z) x is 1 there and 0 at the
// other nine nodes.
Vec3 twisted(const Vec3& u) { return {u[0], u[1], u[2] + 0.6 * 4 * (1 - u[0] - u[1] - u[2]) * u[0]}; }

} // namespace

Vec3 Domain::position(const LatticePoint& point) const {
    const Parameters& p = m_parameters;
    switch (p.mesh) {
    case MeshKind::box:
        return in_box(p, point.u);
    case MeshKind::waves:
        return waves(p, point.u);
    case MeshKind::ball:
        return scaled(blend<3>(symmetric(point.u), core_extent, point.t), p.radius);
    case MeshKind::hemisphere:
        return scaled(blend<3>({2 * point.u[0] - 1, 2 * point.u[1] - 1, point.u[2]}, core_extent, point.t), p.radius);
    case MeshKind::shell:
        return scaled(blend<3>(symmetric(point.u), 0, 1), p.inner_radius + (p.radius - p.inner_radius) * point.t);
    case MeshKind::torus:
        return torus(p, point);
    case MeshKind::twisted_tetrahedron:
        return twisted(point.u);
    }
    return {};
}

} // namespace generator
