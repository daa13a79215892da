// Bezier patches as cut surfaces, against Newton's method from every cell of a fine net of each patch, in extended precision.
#include "surface_fixture.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

constexpr std::uint32_t patch_picture_size = 64;
constexpr int n_cells = 24;

using Net = std::array<LongVector, 16>;

std::array<long double, 4> weights(long double t) {
    const long double s = 1 - t;
    return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}
std::array<long double, 4> slopes(long double t) {
    const long double s = 1 - t;
    return {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
}

LongVector combine(const Net& net, const std::array<long double, 4>& u, const std::array<long double, 4>& v) {
    LongVector sum = LongVector::Zero();
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            sum += u[i] * v[j] * net[4 * i + j];
    return sum;
}

struct PatchCrossing {
    double t;
    Vector normal;
};

class Reference {
public:
    explicit Reference(const PatchMesh& mesh) {
        for (const BezierPatch& patch : mesh.patches) {
            Net net;
            for (std::size_t i = 0; i < 16; ++i)
                net[i] = LongVector(patch.points[i][0], patch.points[i][1], patch.points[i][2]);
            m_nets.push_back(net);
            std::vector<Vector> points;
            for (int i = 0; i <= n_cells; ++i)
                for (int j = 0; j <= n_cells; ++j)
                    points.push_back(combine(net, weights(1.0L * i / n_cells), weights(1.0L * j / n_cells)).cast<double>());
            m_points.push_back(std::move(points));
        }
    }

    std::vector<PatchCrossing> crossings(const Ray& ray, double from, double to) const {
        std::vector<PatchCrossing> found;
        const LongVector d = ray.direction, x = d.unitOrthogonal(), y = d.cross(x);
        const Vector o = ray.origin.cast<double>(), xd = x.cast<double>(), yd = y.cast<double>();
        for (std::size_t patch = 0; patch < m_nets.size(); ++patch) {
            std::vector<Eigen::Vector2d> flat;
            for (const Vector& point : m_points[patch])
                flat.emplace_back((point - o).dot(xd), (point - o).dot(yd));
            for (int i = 0; i < n_cells; ++i)
                for (int j = 0; j < n_cells; ++j) {
                    const auto at = [&](int k, int l) {
                        return flat[static_cast<std::size_t>((i + k) * (n_cells + 1) + j + l)];
                    };
                    const Eigen::Vector2d low = at(0, 0).cwiseMin(at(0, 1)).cwiseMin(at(1, 0)).cwiseMin(at(1, 1));
                    const Eigen::Vector2d high = at(0, 0).cwiseMax(at(0, 1)).cwiseMax(at(1, 0)).cwiseMax(at(1, 1));
                    const double margin = 0.5 * (high - low).maxCoeff();
                    if (low.maxCoeff() > margin || high.minCoeff() < -margin)
                        continue;
                    for (const auto& [a, b] : {std::pair(0.5, 0.5), std::pair(0.1, 0.1), std::pair(0.9, 0.1),
                                               std::pair(0.1, 0.9), std::pair(0.9, 0.9)})
                        newton(m_nets[patch], ray, x, y, (i + a) / n_cells, (j + b) / n_cells, from, to, found);
                }
        }
        std::sort(found.begin(), found.end(), [](const PatchCrossing& a, const PatchCrossing& b) { return a.t < b.t; });
        return found;
    }

private:
    static void newton(const Net& net, const Ray& ray, const LongVector& x, const LongVector& y, long double u, long double v,
                       double from, double to, std::vector<PatchCrossing>& found) {
        for (int step = 0; step < 20; ++step) {
            const LongVector off = combine(net, weights(u), weights(v)) - ray.origin;
            const LongVector along_u = combine(net, slopes(u), weights(v)), along_v = combine(net, weights(u), slopes(v));
            Eigen::Matrix<long double, 2, 2> jacobian;
            jacobian << along_u.dot(x), along_v.dot(x), along_u.dot(y), along_v.dot(y);
            if (jacobian.determinant() == 0)
                return;
            const Eigen::Matrix<long double, 2, 1> change =
                -jacobian.inverse() * Eigen::Matrix<long double, 2, 1>(off.dot(x), off.dot(y));
            u += change[0];
            v += change[1];
            if (!(std::abs(u) < 3 && std::abs(v) < 3))
                return;
            if (change.cwiseAbs().maxCoeff() < 1e-17L) {
                const long double rounding = 1e-15L;
                const double t = static_cast<double>((combine(net, weights(u), weights(v)) - ray.origin).dot(ray.direction));
                if (std::min(u, v) >= -rounding && std::max(u, v) <= 1 + rounding && t >= from && t <= to)
                    found.push_back({t, along_u.cross(along_v).cast<double>()});
                return;
            }
        }
    }

    std::vector<Net> m_nets;
    std::vector<std::vector<Vector>> m_points;
};

// Patches over a lattice of 3 n + 1 points a side that neighbours share.
PatchMesh sheet(int n, const std::function<Vector(double, double)>& at) {
    PatchMesh mesh;
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) {
            BezierPatch patch;
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) {
                    const Vector p = at((3.0 * k + i) / (3 * n), (3.0 * l + j) / (3 * n));
                    patch.points[static_cast<std::size_t>(4 * i + j)] = {p.x(), p.y(), p.z()};
                }
            mesh.patches.push_back(patch);
        }
    return mesh;
}

void check(const std::string& name, PatchMesh patches, const Camera& camera) {
    const TemporaryFile file("bezier-surface.h5");
    write_volume(file.path(), two_blocks());
    const auto mesh = std::make_shared<const PatchMesh>(std::move(patches));
    const Reference reference(*mesh);
    const CutShape shape = BezierSurface{mesh};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        SurfaceScene scene(file.path(), precision);
        const SurfaceSolver solver(device(), precision, shape, scene.data().bounds());
        const SurfacePicture picture = scene.draw(solver, shape, camera, patch_picture_size, patch_picture_size);
        Vector normal;
        const SurfaceComparison found = compare(
            picture, camera, patch_picture_size, patch_picture_size,
            [&](const Ray& ray, double from, double to) {
                for (const PatchCrossing& crossing : reference.crossings(ray, from, to))
                    if (is_in_two_blocks((ray.origin + crossing.t * ray.direction).cast<double>())) {
                        normal = crossing.normal;
                        return std::vector<double>{crossing.t};
                    }
                return std::vector<double>();
            },
            [&](const Vector&) { return normal; }, is_in_two_blocks);
        const bool is_single = precision == Precision::float32;
        WARN(name << (is_single ? ", float32: " : ", float64: ") << to_text(found));
        CHECK(found.hits > 500);
        CHECK(found.missed == 0);
        CHECK(found.extra == 0);
        CHECK(found.undecided <= 10);
        CHECK(found.depth_error <= (is_single ? 1e-5 : 1e-12));
        CHECK(found.distance_error <= (is_single ? 1e-6 : 1e-12));
        CHECK(found.normal_error <= (is_single ? 1e-4 : 1e-9));
        CHECK(picture.counts.newton_failures == 0);
        CHECK(picture.counts.work_limit_pixels == 0);
    }
}

} // namespace

TEST_CASE("Bezier patches are drawn exactly, where rays meet them often, too") {
    check("wavy sheet",
          sheet(2,
                [](double a, double b) -> Vector {
                    return {0.9 * (2 * a - 1), 0.9 * (2 * b - 1), 0.5 * std::sin(9 * a) * std::cos(11 * b)};
                }),
          camera_at({2.9, 1.3, 0.9}));
    check("rolled sheet",
          sheet(2,
                [](double a, double b) -> Vector {
                    const double angle = 7 * a, radius = 0.3 + 0.5 * a;
                    return {radius * std::cos(angle), 1.8 * b - 0.9, radius * std::sin(angle)};
                }),
          camera_at({3.3, 0.5, 1.4}));
}

TEST_CASE("no ray passes between patches that share an edge") {
    const TemporaryFile file("bezier-watertight.h5");
    write_volume(file.path(), two_blocks());
    constexpr int n = 4;
    for (const double tilt : {0.0, 0.37}) {
        const Eigen::AngleAxisd turn(tilt, Vector(0.3, 0.5, 0.2).normalized());
        // Control points on a lattice across the view: edges of patches are straight there, at quarters of the picture.
        const CutShape shape = BezierSurface{std::make_shared<const PatchMesh>(sheet(n, [&](double a, double b) -> Vector {
            return Vector(0.65, 0, 0) + turn * Vector(0.06 * std::sin(13 * a) * std::cos(17 * b), 0.6 * a - 0.3, 0.6 * b - 0.3);
        }))};
        constexpr std::uint32_t side = 113;
        check_no_gaps(file.path(), shape, turn, side, 0.6 * side / 128, "rays with edges and corners");
    }
}

} // namespace elvis::oracle
