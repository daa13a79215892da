#include "scenes.hpp"

#include <core/oracle/isosurface/scalar.hpp>
#include <core/oracle/volume/transfers.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace elvis::hunt {
namespace {

using oracle::Random;
using oracle::Vector;

Vector3 array_of(const Vector& v) { return {v.x(), v.y(), v.z()}; }

double size_of(const SceneGround& ground) { return (ground.upper - ground.lower).norm(); }

std::size_t random_element(Random& random, const SceneGround& ground) {
    return static_cast<std::size_t>(random.whole(0, static_cast<int>(ground.volume->n_elements()) - 1));
}

/** Inside of the shape, or exactly in a face, an edge, or a corner. */
Vector random_xi(Random& random, native::Shape shape, int kind) {
    if (kind == 0)
        for (;;) {
            const Vector xi = random.in_cube();
            if (oracle::excess(shape, xi) <= 0)
                return xi;
        }
    const auto corners = native::face_corners(shape, random.whole(0, native::n_faces(shape) - 1));
    const auto corner = [&](std::size_t i) {
        const native::Point xi = native::corner(shape, corners[i]);
        return Vector(xi[0], xi[1], xi[2]);
    };
    const auto part = [&] { return random.one_in(2) ? 0.5 : random.between(0, 1); };
    if (kind == 3)
        return corner(0);
    const double a = part();
    if (kind == 2)
        return (1 - a) * corner(0) + a * corner(1);
    const double b = (1 - a) * part();
    return (1 - a - b) * corner(0) + a * corner(1) + b * corner(2);
}

Vector random_point(Random& random, const SceneGround& ground, int kind) {
    const std::size_t element = random_element(random, ground);
    return ground.volume->position(element, random_xi(random, ground.volume->shape(element), kind));
}

SceneCamera random_camera(Random& random, const SceneGround& ground) {
    SceneCamera camera;
    const double size = size_of(ground);
    const Vector centre = 0.5 * (ground.lower + ground.upper), direction = random.direction();
    const double distance = random.between(0.55, 2) * size;
    Vector eye = centre + distance * direction, look_at = centre + 0.05 * size * random.in_cube();
    camera.field_of_view = random.between(0.5, 1) * std::atan(0.5 * size / distance) * 360 / std::numbers::pi;
    if (random.one_in(5)) {
        eye = random_point(random, ground, random.one_in(2) ? 0 : random.whole(1, 3));
        do
            look_at = random_point(random, ground, 0);
        while ((look_at - eye).norm() < 1e-3 * size);
        camera.field_of_view = random.between(40, 110);
    }
    if (random.one_in(10))
        camera.field_of_view = random.one_in(2) ? random.between(130, 175) : random.between(0.5, 3);
    // Along an axis, rays and faces of boxes are parallel.
    if (random.one_in(10))
        eye = look_at + distance * Vector::Unit(random.whole(0, 2));
    camera.eye = array_of(eye);
    camera.look_at = array_of(look_at);
    camera.up = array_of((look_at - eye).unitOrthogonal());
    if (random.one_in(6)) {
        camera.orthographic = true;
        camera.field_of_view.reset();
        camera.height = random.between(0.3, 1) * size;
    }
    return camera;
}

SceneColorMap random_map(Random& random, const SceneGround& ground) {
    SceneColorMap map;
    const int n = random.whole(2, 5);
    for (int i = 0; i < n; ++i)
        map.points.push_back(
            {static_cast<double>(i) / (n - 1), {random.between(0, 1), random.between(0, 1), random.between(0, 1)}});
    map.range = {ground.low, ground.high > ground.low ? ground.high : ground.low + 1};
    return map;
}

/** Through random points, or exactly in faces, edges or corners where elements are straight; or across an axis. */
CutPlane random_plane(Random& random, const SceneGround& ground) {
    const int kind = random.whole(0, 4);
    if (kind <= 1) {
        const Vector normal = random.direction(), at = random_point(random, ground, random.one_in(2) ? 0 : random.whole(1, 3));
        return {{normal.x(), normal.y(), normal.z(), -normal.dot(at)}};
    }
    if (kind == 2) {
        const std::size_t element = random_element(random, ground);
        const native::Shape shape = ground.volume->shape(element);
        const auto corners = native::face_corners(shape, random.whole(0, native::n_faces(shape) - 1));
        std::array<Vector, 3> x;
        for (std::size_t i = 0; i < 3; ++i) {
            const native::Point xi = native::corner(shape, corners[i]);
            x[i] = ground.volume->position(element, {xi[0], xi[1], xi[2]});
        }
        const Vector normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
        if (normal.allFinite() && normal.norm() > 0.5)
            return {{normal.x(), normal.y(), normal.z(), -normal.dot(x[0])}};
    }
    const Vector normal = Vector::Unit(random.whole(0, 2)), at = random_point(random, ground, kind == 3 ? 3 : 0);
    return {{normal.x(), normal.y(), normal.z(), -normal.dot(at)}};
}

/** At a point, at one where elements meet, or near an extremum or saddle. */
double random_value(Random& random, const SceneGround& ground) {
    const oracle::Scalar scalar = oracle::scalar_of_field(*ground.volume, ground.component);
    const std::size_t element = random_element(random, ground);
    const native::Shape shape = ground.volume->shape(element);
    const int kind = random.whole(0, 3);
    if (kind <= 1)
        return scalar(*ground.volume, element, random_xi(random, shape, 0), nullptr);
    if (kind == 2)
        return scalar(*ground.volume, element, random_xi(random, shape, random.whole(1, 3)), nullptr);
    // Newton's method on the gradient ends in an extremum or saddle.
    Vector xi = random_xi(random, shape, 0), slope;
    for (int turn = 0; turn < 8; ++turn) {
        constexpr double h = 1e-4;
        oracle::Matrix bend;
        for (Eigen::Index d = 0; d < 3; ++d) {
            Vector above, below;
            scalar(*ground.volume, element, xi + h * Vector::Unit(d), &above);
            scalar(*ground.volume, element, xi - h * Vector::Unit(d), &below);
            bend.col(d) = (above - below) / (2 * h);
        }
        scalar(*ground.volume, element, xi, &slope);
        const Vector step = bend.fullPivLu().solve(slope);
        if (!step.allFinite() || oracle::excess(shape, xi - step) > 0)
            break;
        xi -= step;
    }
    const double off = (ground.high - ground.low) * std::pow(10.0, -random.between(2, 8)) * (random.one_in(2) ? 1 : -1);
    return scalar(*ground.volume, element, xi, nullptr) + off;
}

std::vector<std::array<double, 4>> random_clip(Random& random, const SceneGround& ground) {
    std::vector<std::array<double, 4>> planes;
    const int n = random.one_in(5) ? random.whole(1, 2) : 0;
    for (int i = 0; i < n; ++i) {
        const Vector normal = random.direction(), at = random_point(random, ground, 0);
        planes.push_back({normal.x(), normal.y(), normal.z(), -normal.dot(at)});
    }
    return planes;
}

CutShape random_shape(Random& random, const SceneGround& ground) {
    const double size = size_of(ground), radius = random.between(0.05, 0.5) * size;
    const Vector at = random_point(random, ground, random.one_in(2) ? 0 : random.whole(1, 3)), axis = random.direction();
    const Vector from = at, to = at + random.between(0.2, 1) * size * axis;
    switch (random.whole(0, 5)) {
    case 0:
        return Sphere{array_of(at), radius};
    case 1:
        return Cylinder{array_of(from), array_of(to), radius, random.one_in(2)};
    case 2:
        return Cone{array_of(from), array_of(to), random.one_in(2) ? 0 : radius, random.between(0.1, 0.5) * size,
                    random.one_in(2)};
    case 3:
        return Torus{array_of(at), array_of(axis), radius, random.between(0.1, 1.2) * radius};
    case 4: {
        auto mesh = std::make_shared<TriangleMesh>();
        for (int i = 0; i < 5; ++i)
            mesh->points.push_back(array_of(at + 0.5 * size * random.in_cube()));
        mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 2, 4}};
        return MeshSurface{mesh};
    }
    default: {
        // Of both signs now and then, about a point.
        Quadric quadric;
        std::array<double, 10>& c = quadric.coefficients;
        for (std::size_t i = 0; i < 6; ++i)
            c[i] = random.between(i < 3 ? -0.3 : -0.4, i < 3 ? 1 : 0.4);
        const double x = at.x(), y = at.y(), z = at.z();
        c[6] = -2 * c[0] * x - c[3] * y - c[5] * z;
        c[7] = -2 * c[1] * y - c[3] * x - c[4] * z;
        c[8] = -2 * c[2] * z - c[4] * y - c[5] * x;
        c[9] = c[0] * x * x + c[1] * y * y + c[2] * z * z + c[3] * x * y + c[4] * y * z + c[5] * z * x -
               random.between(-0.2, 1) * radius * radius;
        return quadric;
    }
    }
}

std::string text_of(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

/** Polynomials up to order four, and waves, about a point. */
ImplicitSurface random_function(Random& random, const SceneGround& ground) {
    const Vector at = random_point(random, ground, random.one_in(2) ? 0 : random.whole(1, 3));
    const double scale = 2 / size_of(ground);
    std::array<std::string, 3> u;
    for (std::size_t d = 0; d < 3; ++d) {
        const double shift = at[static_cast<Eigen::Index>(d)];
        u[d] = text_of(scale) + " * (" + "xyz"[d] + (shift < 0 ? " + " : " - ") + text_of(std::abs(shift)) + ")";
    }
    const auto part = [&] { return text_of(random.between(0.1, 1)); };
    const auto sign = [&] { return random.one_in(3) ? " - " : " + "; };
    std::string text;
    switch (random.whole(0, 2)) {
    case 0:
        for (const std::string& x : u)
            text += (text.empty() ? "" : sign()) + part() + " * (" + x + ")^" + (random.one_in(2) ? "2" : "4");
        text += sign() + part() + " * " + u[0] + " * " + u[1] + " * " + u[2];
        return {text + " - " + text_of(random.between(0, 0.3))};
    case 1: {
        const std::string wave = text_of(random.between(1, 6));
        return {u[2] + sign() + part() + " * " + u[0] + sign() + text_of(random.between(0.02, 0.4)) + " * sin(" + wave + " * " +
                u[0] + ") * cos(" + wave + " * " + u[1] + ")"};
    }
    default: {
        const std::string wave = text_of(random.between(1, 5)) + " * ";
        for (std::size_t d = 0; d < 3; ++d)
            text += (d == 0 ? "" : " + ") + ("sin(" + wave) + u[d] + ") * cos(" + wave + u[(d + 1) % 3] + ")";
        return {text + sign() + text_of(random.between(0, 0.5))};
    }
    }
}

SceneSurface random_surface(Random& random, const SceneGround& ground, std::string_view kind) {
    SceneSurface surface;
    // A file without faces does not tell its boundary.
    if (kind == "plane" || (kind == "boundary" && !ground.has_faces)) {
        surface.geometry = random_plane(random, ground);
    } else if (kind == "shape" || kind == "implicit") {
        if (kind == "shape")
            surface.geometry = random_shape(random, ground);
        else
            surface.geometry = CutShape(random_function(random, ground));
        if (random.one_in(3))
            surface.outside = Rgb{0.5, 0.5, 0.5};
    } else if (kind == "boundary") {
        surface.geometry = BoundaryFaces{};
    } else {
        auto& isosurfaces = surface.geometry.emplace<Isosurfaces>();
        const int n = random.one_in(3) ? random.whole(2, 3) : 1;
        for (int i = 0; i < n; ++i)
            isosurfaces.values.push_back(random_value(random, ground));
        std::ranges::sort(isosurfaces.values);
        isosurfaces.skips_by_range = !random.one_in(5);
        if (random.one_in(5))
            isosurfaces.method = random.one_in(2) ? IsosurfaceMethod::bernstein : IsosurfaceMethod::companion;
    }
    surface.color_map = random_map(random, ground);
    surface.clip = random_clip(random, ground);
    return surface;
}

SceneLineStyle random_style(Random& random) {
    const auto color = [&] { return Rgb{random.between(0, 1), random.between(0, 1), random.between(0, 1)}; };
    SceneLineStyle style;
    style.width = random.one_in(3) ? random.between(1, 6) : 1;
    style.color = color();
    if (random.one_in(2))
        style.undecided_color = color();
    return style;
}

/** Contours, or mesh lines, or both. */
void add_lines(Random& random, const SceneGround& ground, SceneSurface& surface) {
    const int kind = random.whole(0, 3);
    if (kind != 0 || std::holds_alternative<Isosurfaces>(surface.geometry))
        surface.mesh_lines = random_style(random);
    // On an isosurface of the same field all is contour, or none.
    if (kind == 1 || std::holds_alternative<Isosurfaces>(surface.geometry))
        return;
    SceneContours& contours = surface.contours.emplace();
    contours.style = random_style(random);
    const int n = random.one_in(3) ? random.whole(5, 30) : random.whole(1, 4);
    for (int i = 0; i < n; ++i)
        contours.values.push_back(random_value(random, ground));
    std::ranges::sort(contours.values);
}

SceneVolumeRendering random_rendering(Random& random, const SceneGround& ground, std::uint64_t number) {
    SceneVolumeRendering rendering;
    rendering.transfer =
        oracle::random_transfer(number, ground.low, std::max(ground.high, ground.low + 1e-3), size_of(ground)).transfer;
    rendering.integrator = random.one_in(4) ? Integrator::adaptive_trapezoid : Integrator::exact;
    rendering.tolerance = random.one_in(3) ? 1e-5 : 1e-3;
    rendering.skips_by_range = !random.one_in(5);
    return rendering;
}

} // namespace

SceneGround ground_of(const std::string& path, const std::string& field, const oracle::Volume& volume, bool has_faces) {
    SceneGround ground{path, field, &volume, volume.n_components() > 1 ? -1 : 0, {}, {}, 0, 0, has_faces};
    const oracle::Scalar scalar = oracle::scalar_of_field(volume, ground.component);
    ground.lower.setConstant(std::numeric_limits<double>::infinity());
    ground.upper = -ground.lower;
    ground.low = std::numeric_limits<double>::infinity();
    ground.high = -ground.low;
    Random random(1);
    const int n_samples = volume.n_elements() < 100 ? 100 : 8;
    for (std::size_t element = 0; element < volume.n_elements(); ++element)
        for (int i = 0; i < n_samples; ++i) {
            const Vector xi = random_xi(random, volume.shape(element), i % 4 == 3 ? 3 : 0);
            const Vector x = volume.position(element, xi);
            const double value = scalar(volume, element, xi, nullptr);
            ground.lower = ground.lower.cwiseMin(x);
            ground.upper = ground.upper.cwiseMax(x);
            ground.low = std::min(ground.low, value);
            ground.high = std::max(ground.high, value);
        }
    return ground;
}

Scene make_scene(const SceneGround& ground, std::string_view kind, std::uint64_t number) {
    Random random(number * 0xD1342543DE82EF95ull + 3);
    Scene scene;
    scene.volume = ground.path;
    scene.field = "\"" + ground.field + "\"";
    scene.camera = random_camera(random, ground);
    scene.size = size_of(kind);
    // Exact in single precision, as the program keeps it.
    scene.background = {0.125, 0.25, 0.375, 1};
    if (kind == "volume") {
        scene.volume_rendering = random_rendering(random, ground, number);
    } else if (kind == "layers") {
        static constexpr std::array<std::string_view, 4> parts{"plane", "isosurface", "boundary", "shape"};
        const int n = random.whole(1, 3);
        for (int i = 0; i < n; ++i) {
            scene.surfaces.push_back(random_surface(random, ground, parts[static_cast<std::size_t>(random.whole(0, 3))]));
            scene.surfaces.back().opacity = random.one_in(4) ? 1 : random.between(0.1, 0.9);
        }
        if (random.one_in(3))
            scene.volume_rendering = random_rendering(random, ground, number);
    } else if (kind == "lines") {
        static constexpr std::array<std::string_view, 7> parts{"plane", "plane", "plane",     "boundary",
                                                               "shape", "shape", "isosurface"};
        scene.surfaces.push_back(random_surface(random, ground, parts[static_cast<std::size_t>(random.whole(0, 6))]));
        add_lines(random, ground, scene.surfaces.back());
        scene.subdivisions = static_cast<std::uint32_t>(random.one_in(3) ? random.whole(0, 9) : 5);
    } else {
        scene.surfaces.push_back(random_surface(random, ground, kind));
    }
    if (!scene.surfaces.empty() && random.one_in(3))
        scene.lighting = Lighting{};
    return scene;
}

std::array<std::uint32_t, 2> size_of(std::string_view kind) {
    if (kind == "plane")
        return {640, 480};
    if (kind == "boundary" || kind == "shape")
        return {400, 300};
    if (kind == "isosurface" || kind == "lines" || kind == "implicit")
        return {240, 180};
    return {160, 120};
}

} // namespace elvis::hunt
