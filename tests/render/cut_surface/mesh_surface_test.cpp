// Meshes of triangles as cut surfaces, against every triangle tested in extended precision for every ray.
#include "surface_fixture.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace elvis::oracle {
namespace {

constexpr std::uint32_t mesh_picture_size = 96;

// A ball of quadrilaterals, each cut in two, with triangles at the poles.
TriangleMesh ball(const Vector& center, double radius, int n) {
    TriangleMesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            const double polar = std::numbers::pi * j / n, around = std::numbers::pi * i / n + 0.1;
            const Vector p = center + radius * Vector(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                                                      j == 0 || j == n ? std::round(std::cos(polar)) : std::cos(polar));
            mesh.points.push_back({p.x(), p.y(), p.z()});
        }
    const auto at = [n](int i, int j) {
        // The poles are one point each.
        return static_cast<std::uint32_t>(j == 0 ? 0 : j == n ? 2 * n * n : 2 * n * j + i % (2 * n));
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            if (j > 0)
                mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (j < n - 1)
                mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

struct TriangleCrossing {
    double t;
    Vector normal;
};

std::vector<TriangleCrossing> all_crossings(const TriangleMesh& mesh, const Ray& ray, double from, double to) {
    std::vector<TriangleCrossing> found;
    const auto point = [&](std::uint32_t i) -> LongVector { return {mesh.points[i][0], mesh.points[i][1], mesh.points[i][2]}; };
    for (const auto& triangle : mesh.triangles) {
        const LongVector a = point(triangle[0]), along = point(triangle[1]) - a, aside = point(triangle[2]) - a;
        const LongVector normal = along.cross(aside);
        const long double across = normal.dot(ray.direction);
        if (across == 0)
            continue;
        const long double t = normal.dot(a - ray.origin) / across;
        const LongVector x = ray.origin + t * ray.direction - a;
        const long double square = normal.squaredNorm();
        const long double u = x.cross(aside).dot(normal) / square, v = along.cross(x).dot(normal) / square;
        // Shared edges belong to both sides.
        const long double rounding = 1e-16L;
        if (u >= -rounding && v >= -rounding && u + v <= 1 + rounding && t >= from && t <= to)
            found.push_back({static_cast<double>(t), normal.cast<double>()});
    }
    std::sort(found.begin(), found.end(), [](const TriangleCrossing& a, const TriangleCrossing& b) { return a.t < b.t; });
    return found;
}

} // namespace

TEST_CASE("meshes of triangles are drawn exactly") {
    const TemporaryFile file("mesh-surface.h5");
    write_volume(file.path(), two_blocks());
    const auto mesh = std::make_shared<const TriangleMesh>(ball({0.2, 0.1, 0}, 0.95, 16));
    const CutShape shape = MeshSurface{mesh};
    const Camera camera = camera_at({2.9, 2.3, 1.7});
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        SurfaceScene scene(file.path(), precision);
        const SurfaceSolver solver(device(), precision, shape, scene.data().bounds());
        const SurfacePicture picture = scene.draw(solver, shape, camera, mesh_picture_size, mesh_picture_size);
        Vector normal;
        const SurfaceComparison found = compare(
            picture, camera, mesh_picture_size, mesh_picture_size,
            [&](const Ray& ray, double from, double to) {
                std::vector<double> distances;
                for (const TriangleCrossing& crossing : all_crossings(*mesh, ray, from, to)) {
                    if (is_in_two_blocks((ray.origin + crossing.t * ray.direction).cast<double>()) && distances.empty()) {
                        distances.push_back(crossing.t);
                        normal = crossing.normal;
                    }
                }
                return distances;
            },
            [&](const Vector&) { return normal; }, is_in_two_blocks);
        const bool is_single = precision == Precision::float32;
        WARN((is_single ? "float32: " : "float64: ") << to_text(found));
        CHECK(found.hits > 1000);
        CHECK(found.missed == 0);
        CHECK(found.extra == 0);
        CHECK(found.undecided <= 10);
        CHECK(found.depth_error <= (is_single ? 1e-5 : 1e-12));
        CHECK(found.distance_error <= (is_single ? 1e-6 : 1e-12));
        // At an edge either side's normal is right.
        CHECK(found.normal_error <= (is_single ? 1e-2 : 1e-2));
        CHECK(picture.counts.newton_failures == 0);
    }
}

TEST_CASE("no ray passes between triangles that share corners") {
    // Rays through corners and along edges: an orthographic picture whose pixels lie on the lattice of a wavy sheet, in rows,
    // columns and diagonals. In the block x > 0.3 only, so that every pixel must be hit.
    const TemporaryFile file("watertight.h5");
    write_volume(file.path(), two_blocks());
    constexpr int n = 64;
    for (const double tilt : {0.0, 0.37}) {
        TriangleMesh mesh;
        const Eigen::AngleAxisd turn(tilt, Vector(0.3, 0.5, 0.2).normalized());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const double a = -0.3 + 0.6 * i / n, b = -0.3 + 0.6 * j / n;
                const Vector p = Vector(0.65, 0, 0) + turn * Vector(0.05 * std::sin(40 * a) * std::cos(37 * b), a, b);
                mesh.points.push_back({p.x(), p.y(), p.z()});
            }
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t corner = j * (n + 1) + i;
                mesh.triangles.push_back({corner, corner + 1, corner + n + 1});
                mesh.triangles.push_back({corner + 1, corner + n + 2, corner + n + 1});
            }
        const CutShape shape = MeshSurface{std::make_shared<const TriangleMesh>(std::move(mesh))};
        // Two pixels a cell: every second one meets a corner, the others edges.
        constexpr std::uint32_t side = 2 * n - 15;
        check_no_gaps(file.path(), shape, turn, side, 0.6 * side / (2 * n), "rays through edges and corners");
    }
}

} // namespace elvis::oracle
