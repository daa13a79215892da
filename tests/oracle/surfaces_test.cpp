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
            const SurfaceSolver solver(surface_device(), precision, one.shape);
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

} // namespace elvis::oracle
