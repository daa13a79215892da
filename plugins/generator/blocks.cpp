#include "blocks.hpp"

#include <cmath>
#include <numbers>

namespace generator {

namespace {

constexpr double pi = std::numbers::pi;
/** Half width of the ball's inner cube and of the torus's inner square, in radii: elements of similar size inside and outside.
 */
constexpr double core_half_width = 0.4;
constexpr double shell_inner_radius = 0.5;
constexpr double torus_minor_radius = 0.4;

/** Cube face directions: axis of the normal with its sign, then the axes along u and v; right-handed with w outwards. */
struct Side {
    std::size_t normal, along_u, along_v;
    double sign;
};
constexpr std::array<Side, 6> sides = {{{0, 1, 2, 1}, {0, 2, 1, -1}, {1, 2, 0, 1}, {1, 0, 2, -1}, {2, 0, 1, 1}, {2, 1, 0, -1}}};

Vector3 normalized(const Vector3& x) {
    const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    return {x[0] / length, x[1] / length, x[2] / length};
}

/** Point of the cube's side at p, q in [-1, 1]; with equal angles if `tangent`. */
Vector3 on_cube(const Side& side, double p, double q, bool tangent) {
    Vector3 x{};
    x[side.normal] = side.sign;
    x[side.along_u] = tangent ? std::tan(pi / 4 * p) : p;
    x[side.along_v] = tangent ? std::tan(pi / 4 * q) : q;
    return x;
}

BlockMesh box(const Description& description, bool waves) {
    BlockMesh mesh;
    mesh.groups = {"z-", "y-", "x+", "y+", "x-", "z+"};
    Block block;
    block.n_cells = description.elements;
    block.group = {0, 1, 2, 3, 4, 5};
    block.is_affine = !waves;
    const auto corners = description.box;
    block.map = [corners, waves](const Vector3& u) {
        Vector3 q{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Exact at both ends.
            q[axis] = (1 - u[axis]) * corners[0][axis] + u[axis] * corners[1][axis];
        }
        if (!waves) {
            return q;
        }
        return Vector3{q[0] + 0.06 * std::sin(pi * q[1]) * std::cos(pi * q[2]),
                       q[1] + 0.06 * std::sin(pi * q[2]) * std::cos(pi * q[0]),
                       q[2] + 0.06 * std::sin(pi * q[0]) * std::cos(pi * q[1])};
    };
    mesh.blocks.push_back(block);
    return mesh;
}

/** Ranges of p and q of a side in the upper half space z >= 0, or none if the side lies below. */
struct SideRange {
    double low_p = -1, low_q = -1;
    bool is_empty = false;
};

SideRange upper_half(const Side& side) {
    SideRange range;
    range.is_empty = side.normal == 2 && side.sign < 0;
    range.low_p = side.along_u == 2 ? 0 : -1;
    range.low_q = side.along_v == 2 ? 0 : -1;
    return range;
}

BlockMesh ball(const Description& description, bool half) {
    BlockMesh mesh;
    mesh.groups = half ? std::vector<std::string>{"sphere", "plane"} : std::vector<std::string>{"sphere"};
    const std::uint32_t n = description.elements[0];
    const std::uint32_t n_half = half ? (n + 1) / 2 : n;

    Block core;
    core.n_cells = {n, n, n_half};
    core.is_core = true;
    core.is_affine = true;
    core.group[0] = half ? 1 : -1;
    core.map = [half](const Vector3& u) {
        return Vector3{core_half_width * (2 * u[0] - 1), core_half_width * (2 * u[1] - 1),
                       core_half_width * (half ? u[2] : 2 * u[2] - 1)};
    };
    mesh.blocks.push_back(core);

    for (const Side& side : sides) {
        const SideRange range = half ? upper_half(side) : SideRange{};
        if (range.is_empty) {
            continue;
        }
        Block block;
        block.n_cells = {range.low_p == 0 ? n_half : n, range.low_q == 0 ? n_half : n, description.elements[2]};
        block.group[5] = 0;
        // The face at z = 0, where p (u = 0) or q (v = 0) begins.
        if (range.low_p == 0) {
            block.group[4] = 1;
        }
        if (range.low_q == 0) {
            block.group[1] = 1;
        }
        block.map = [side, range](const Vector3& u) {
            const double p = (1 - u[0]) * range.low_p + u[0];
            const double q = (1 - u[1]) * range.low_q + u[1];
            const Vector3 inner = on_cube(side, p, q, false);
            const Vector3 outer = normalized(on_cube(side, p, q, true));
            Vector3 x{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                x[axis] = (1 - u[2]) * core_half_width * inner[axis] + u[2] * outer[axis];
            }
            return x;
        };
        mesh.blocks.push_back(block);
    }
    return mesh;
}

BlockMesh shell(const Description& description) {
    BlockMesh mesh;
    mesh.groups = {"inner", "outer"};
    for (const Side& side : sides) {
        Block block;
        block.n_cells = {description.elements[0], description.elements[0], description.elements[2]};
        block.group[0] = 0;
        block.group[5] = 1;
        block.map = [side](const Vector3& u) {
            Vector3 x = normalized(on_cube(side, 2 * u[0] - 1, 2 * u[1] - 1, true));
            const double radius = (1 - u[2]) * shell_inner_radius + u[2];
            for (double& coordinate : x) {
                coordinate *= radius;
            }
            return x;
        };
        mesh.blocks.push_back(block);
    }
    return mesh;
}

/** Carries a point of the cross-section (outwards, along z) round the torus. */
Vector3 around(double outwards, double z, double w) {
    const double angle = 2 * pi * w;
    return {(1 + outwards) * std::cos(angle), (1 + outwards) * std::sin(angle), z};
}

BlockMesh torus(const Description& description) {
    BlockMesh mesh;
    mesh.groups = {"surface"};
    const std::uint32_t n = description.elements[0];
    constexpr double half_width = core_half_width * torus_minor_radius;

    // (outwards, z, around) is left-handed: u runs along z, so that Jacobians are positive.
    Block core;
    core.n_cells = {n, n, description.elements[2]};
    core.is_periodic = true;
    core.map = [](const Vector3& u) { return around(half_width * (2 * u[1] - 1), half_width * (2 * u[0] - 1), u[2]); };
    mesh.blocks.push_back(core);

    for (int quarter = 0; quarter < 4; ++quarter) {
        Block block;
        block.n_cells = {description.elements[1], n, description.elements[2]};
        block.is_periodic = true;
        block.group[2] = 0;
        block.map = [quarter](const Vector3& u) {
            const double q = 2 * u[1] - 1;
            const double along = u[0];
            // Side of the square at angle 0, then turned by quarters.
            const double t = std::tan(pi / 4 * q);
            const double length = std::sqrt(1 + t * t);
            const double a = (1 - along) * half_width + along * torus_minor_radius / length;
            const double b = (1 - along) * half_width * q + along * torus_minor_radius * t / length;
            constexpr std::array<std::array<double, 2>, 4> turns = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
            const auto [c, s] = turns[static_cast<std::size_t>(quarter)];
            // Turned in the plane (z, outwards), the right-handed one.
            return around(s * a + c * b, c * a - s * b, u[2]);
        };
        mesh.blocks.push_back(block);
    }
    return mesh;
}

} // namespace

BlockMesh make_blocks(const Description& description) {
    return description.mesh == "waves"        ? box(description, true)
           : description.mesh == "ball"       ? ball(description, false)
           : description.mesh == "hemisphere" ? ball(description, true)
           : description.mesh == "shell"      ? shell(description)
           : description.mesh == "torus"      ? torus(description)
                                              : box(description, false);
}

} // namespace generator
