// Cut surfaces given by formulas against sign changes of the same formulas along every ray, in extended precision.
#include "surface_fixture.hpp"

#include <Eigen/Geometry>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

struct Case {
    std::string name;
    CutShape shape;
    LevelFunction function;
    Camera camera;
    int n_samples = 300;
};

LongVector vector(const Vector3& v) { return {v[0], v[1], v[2]}; }

// Distance from the axis, and height along it.
std::pair<long double, long double> round_coordinates(const LongVector& x, const Vector3& from, const LongVector& axis) {
    const LongVector relative = x - vector(from);
    const long double height = relative.dot(axis);
    return {(relative - height * axis).norm(), height};
}

LevelFunction level_of(const Sphere& sphere) {
    return [=](const LongVector& x) { return (x - vector(sphere.center)).norm() - sphere.radius; };
}

// Of the solid: positive outside.
LevelFunction level_of(const Cone& cone) {
    return [=](const LongVector& x) {
        const LongVector axis = vector(cone.to) - vector(cone.from);
        const auto [distance, height] = round_coordinates(x, cone.from, axis.normalized());
        const long double radius = cone.from_radius + (cone.to_radius - cone.from_radius) * height / axis.norm();
        return std::max(distance - radius, std::max(-height, height - axis.norm()));
    };
}

LevelFunction level_of(const Quadric& quadric) {
    return [=](const LongVector& p) {
        const auto& c = quadric.coefficients;
        const long double x = p.x(), y = p.y(), z = p.z();
        return c[0] * x * x + c[1] * y * y + c[2] * z * z + c[3] * x * y + c[4] * y * z + c[5] * z * x + c[6] * x + c[7] * y +
               c[8] * z + c[9];
    };
}

LevelFunction level_of(const Torus& torus) {
    return [=](const LongVector& x) {
        const auto [distance, height] = round_coordinates(x, torus.center, vector(torus.axis).normalized());
        return std::hypot(distance - static_cast<long double>(torus.major_radius), height) - torus.minor_radius;
    };
}

template <class Shape> Case make(const std::string& name, const Shape& shape, const Camera& camera) {
    return {name, shape, level_of(shape), camera};
}

std::function<Vector(const Vector&)> gradient_of(const LevelFunction& function) {
    return [=](const Vector& x) -> Vector {
        Vector gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const LongVector step = 1e-7L * LongVector::Unit(axis);
            gradient[axis] =
                static_cast<double>(function(x.cast<long double>() + step) - function(x.cast<long double>() - step));
        }
        return gradient;
    };
}

constexpr std::uint32_t size = 96;

void check(const std::vector<Case>& cases) {
    const TemporaryFile file("surfaces.h5");
    write_volume(file.path(), two_blocks());
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        SurfaceScene scene(file.path(), precision);
        const bool is_single = precision == Precision::float32;
        for (const Case& one : cases) {
            const SurfaceSolver solver(device(), precision, one.shape, scene.data().bounds());
            const SurfacePicture picture = scene.draw(solver, one.shape, one.camera, size, size);
            const SurfaceComparison found = compare(
                picture, one.camera, size, size,
                [&](const Ray& ray, double from, double to) { return crossings(ray, one.function, from, to, one.n_samples); },
                gradient_of(one.function), is_in_two_blocks);
            WARN(one.name << (is_single ? ", float32: " : ", float64: ") << to_text(found));
            CHECK(found.hits > 150);
            CHECK(found.missed == 0);
            CHECK(found.extra == 0);
            CHECK(found.undecided <= (is_single ? 12 : 2));
            CHECK(found.depth_error <= (is_single ? 1e-5 : 1e-12));
            CHECK(found.distance_error <= (is_single ? 1e-6 : 1e-12));
            CHECK(found.value_error <= (is_single ? 1e-4 : 1e-10));
            CHECK(picture.counts.newton_failures == 0);
        }
    }
    CHECK(device().validation_messages().empty());
}

} // namespace

TEST_CASE("spheres are drawn exactly, small and huge, in front of and around the eye") {
    check({make("sphere", Sphere{{0.1, 0, 0.05}, 0.9}, camera_at({2.9, 2.3, 1.7})),
           make("sphere that reaches out of the volume", Sphere{{0, 0.2, 0}, 1.2}, camera_at({2.9, 2.3, 1.7})),
           make("small sphere", Sphere{{0.6, -0.3, 0.4}, 0.02}, camera_at({2.9, 2.3, 1.7}, 1, {0.6, -0.3, 0.4})),
           make("huge sphere", Sphere{{3000, 2500, 2000}, 4387.482}, camera_at({2.9, 2.3, 1.7})),
           make("sphere around the eye", Sphere{{0, 0, 0}, 0.8}, camera_at({0.1, 0.05, 0.12}, 100))});
}

TEST_CASE("cylinders and cones are drawn exactly, with their caps and without") {
    check({make("cylinder", Cone{{-0.8, -0.5, -0.3}, {0.7, 0.6, 0.4}, 0.4, 0.4, true}, camera_at({2.9, 2.3, 1.7})),
           make("cone", Cone{{-0.9, -0.5, -0.3}, {0.8, 0.5, 0.4}, 0, 0.6, true}, camera_at({2.9, 1.3, -1.7})),
           make("thin cylinder", Cone{{-3, -0.5, -0.3}, {3, 0.6, 0.4}, 0.05, 0.05, true}, camera_at({1.2, -2.3, 2.7}))});
}

TEST_CASE("quadrics are drawn exactly") {
    check({make("ellipsoid", Quadric{{2, 1, 3, 0.5, 0.2, -0.3, 0.1, 0, 0.2, -0.9}}, camera_at({2.9, 2.3, 1.7})),
           make("hyperboloid", Quadric{{1, 1, -1, 0.2, 0, 0, 0, 0, 0, -0.2}}, camera_at({2.9, 2.3, 1.7})),
           make("saddle", Quadric{{1, -1, 0, 0, 0, 0, 0, 0, 1, 0.1}}, camera_at({2.9, 2.3, 1.7})),
           make("plane", Quadric{{0, 0, 0, 0, 0, 0, 0.5, 1, 0.3, 0.1}}, camera_at({2.9, 2.3, 1.7})),
           make("elliptic cylinder", Quadric{{1, 2, 0, 1, 0, 0, 0, 0, 0, -0.6}}, camera_at({0.9, 0.3, 2.7}))});
}

TEST_CASE("surfaces given by expressions are drawn exactly") {
    const auto implicit = [](const std::string& text, const LevelFunction& function, const Camera& camera,
                             int n_samples = 300) {
        return Case{text, ImplicitSurface{text}, function, camera, n_samples};
    };
    check({implicit(
               "x^2 + y^2 + z^2 - 0.81", [](const LongVector& p) { return p.squaredNorm() - static_cast<long double>(0.81); },
               camera_at({2.9, 2.3, 1.7})),
           implicit(
               "sin(5*x)*cos(5*y) + sin(5*y)*cos(5*z) + sin(5*z)*cos(5*x)",
               [](const LongVector& p) {
                   const long double x = 5 * p.x(), y = 5 * p.y(), z = 5 * p.z();
                   return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
               },
               camera_at({2.9, 2.3, 1.7})),
           implicit(
               "max(abs(x - 0.6), max(abs(y), abs(z))) - 0.25",
               [](const LongVector& p) {
                   return std::max(std::abs(p.x() - static_cast<long double>(0.6)),
                                   std::max(std::abs(p.y()), std::abs(p.z()))) -
                          0.25L;
               },
               camera_at({2.9, 2.3, 1.7}, 20, {0.6, 0, 0})),
           implicit(
               "x < 0.5 ? z - 0.2*x : z + 0.5*exp(-y^2) - 0.6",
               [](const LongVector& p) {
                   return p.x() < 0.5L ? p.z() - static_cast<long double>(0.2) * p.x()
                                       : p.z() + 0.5L * std::exp(-p.y() * p.y()) - static_cast<long double>(0.6);
               },
               camera_at({2.9, 2.3, 2.7}), 3000)});
}

TEST_CASE("tori are drawn exactly, thick, thin and spindle") {
    check({make("torus", Torus{{0, 0.1, 0}, {0.3, 0.2, 1}, 0.6, 0.3}, camera_at({2.9, 2.3, 1.7})),
           make("torus from the side", Torus{{0, 0.1, 0}, {1, 0.2, 0.1}, 0.6, 0.25}, camera_at({0.2, -3.3, 0.1})),
           make("thin torus", Torus{{0, 0, 0}, {0, 0.2, 1}, 0.85, 0.03}, camera_at({2.9, 2.3, 1.7})),
           make("spindle torus", Torus{{0.5, 0, 0}, {0.3, 0.2, 1}, 0.2, 0.4}, camera_at({2.9, 2.3, 1.7})),
           make("torus around the eye", Torus{{0.5, 0, 0}, {0.3, 0.2, 1}, 0.4, 0.3}, camera_at({0.5, 0.4, 0.0}, 90))});
}

TEST_CASE("what lies behind a crossing is found by asking beyond it") {
    // Whether crossing after crossing, each drawn beyond the last, gives all there are in the volume.
    const TemporaryFile file("beyond.h5");
    write_volume(file.path(), two_blocks());
    const Torus torus{{0, 0.1, 0}, {1, 0.2, 0.1}, 0.6, 0.25};
    const ImplicitSurface gyroid{"sin(5*x)*cos(5*y) + sin(5*y)*cos(5*z) + sin(5*z)*cos(5*x)"};
    const LevelFunction of_gyroid = [](const LongVector& p) {
        const long double x = 5 * p.x(), y = 5 * p.y(), z = 5 * p.z();
        return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
    };
    const Camera camera = camera_at({3.2, -1.3, 0.3});
    constexpr std::uint32_t side = 48;
    for (const Precision precision : {Precision::float32, Precision::float64})
        for (const auto& [shape, function] : {std::pair<CutShape, LevelFunction>(torus, level_of(torus)),
                                              std::pair<CutShape, LevelFunction>(gyroid, of_gyroid)}) {
            SurfaceScene scene(file.path(), precision);
            const SurfaceSolver solver(device(), precision, shape, scene.data().bounds());
            std::vector<std::vector<double>> found(side * side);
            std::vector<std::uint32_t> flags(side * side, 0);
            std::vector<double> beyond;
            for (int round = 0; round < 40; ++round) {
                const SurfacePicture picture = scene.draw(solver, shape, camera, side, side, beyond);
                beyond.assign(side * side, 3e38);
                bool is_done = true;
                for (std::size_t pixel = 0; pixel < found.size(); ++pixel) {
                    flags[pixel] |= picture.flags[pixel];
                    if (picture.element[pixel] >= 0) {
                        found[pixel].push_back(picture.depth[pixel]);
                        beyond[pixel] = picture.depth[pixel];
                        is_done = false;
                    }
                }
                if (is_done)
                    break;
            }
            std::size_t n_found = 0, n_expected = 0, n_wrong = 0, n_undecided = 0;
            for (std::uint32_t row = 0; row < side; ++row)
                for (std::uint32_t column = 0; column < side; ++column) {
                    const std::size_t pixel = std::size_t{row} * side + column;
                    const Ray ray = pixel_ray(camera, side, side, column, row);
                    std::size_t expected = 0;
                    for (const double t : crossings(ray, function, 1, 6, 1500))
                        expected += is_in_two_blocks((ray.origin + t * ray.direction).cast<double>()) ? 1 : 0;
                    if ((flags[pixel] & pixel_flag::undecided) != 0) {
                        ++n_undecided;
                        continue;
                    }
                    n_expected += expected;
                    n_found += found[pixel].size();
                    n_wrong += expected != found[pixel].size() ? 1 : 0;
                }
            WARN((precision == Precision::float32 ? "float32: " : "float64: ")
                 << n_found << " crossings found of " << n_expected << ", wrong in " << n_wrong << " pixels, " << n_undecided
                 << " undecided");
            CHECK(n_expected > 250);
            CHECK(n_wrong == 0);
            CHECK(n_undecided <= (precision == Precision::float32 ? 12 : 2));
        }
}

TEST_CASE("a surface outside of the volume is shown if asked for") {
    const TemporaryFile file("outside.h5");
    write_volume(file.path(), two_blocks());
    // Reaches out of the volume, and over the gap in it.
    const Sphere sphere{{0, 0.2, 0}, 1.2};
    const Camera camera = camera_at({2.9, 2.3, 1.7}, 55);
    SurfaceScene scene(file.path(), Precision::float64);
    const SurfaceSolver solver(device(), Precision::float64, sphere, scene.data().bounds());
    const SurfacePicture picture = scene.draw(solver, sphere, camera, size, size, {}, true);
    std::size_t n_inside = 0, n_outside = 0, n_wrong = 0;
    for (std::uint32_t row = 0; row < size; ++row)
        for (std::uint32_t column = 0; column < size; ++column) {
            const std::size_t pixel = std::size_t{row} * size + column;
            const Ray ray = pixel_ray(camera, size, size, column, row);
            const std::vector<double> all = crossings(ray, level_of(sphere), 1e-6, 10, 300);
            const bool is_inside = !all.empty() && is_in_two_blocks((ray.origin + all[0] * ray.direction).cast<double>());
            const bool is_right = all.empty() ? picture.element[pixel] == -1
                                  : is_inside ? picture.element[pixel] >= 0
                                              : picture.element[pixel] == outside_element;
            const bool is_near = all.empty() || std::abs(picture.depth[pixel] - all[0]) < 1e-9;
            n_inside += is_inside ? 1 : 0;
            n_outside += !all.empty() && !is_inside ? 1 : 0;
            n_wrong += is_right && is_near ? 0 : 1;
        }
    WARN(n_inside << " pixels inside, " << n_outside << " outside, " << n_wrong << " wrong");
    CHECK(n_inside > 300);
    CHECK(n_outside > 300);
    CHECK(n_wrong == 0);
}

} // namespace elvis::oracle
