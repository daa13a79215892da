// The oracle for isosurfaces against closed forms, and its three ways to find roots against each other.
#include "isosurface.hpp"
#include "meshes.hpp"
#include "random_volumes.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace elvis::oracle {
namespace {

using native::Shape;

// The cube [-1,1]^3 of cells of one shape, bent, with a field that is a function of the place before the bend.
VolumeData bent_cube(Shape shape, int n, std::uint32_t order, const std::function<Vector(const Vector&)>& bend, const Function& field) {
    const std::vector<Map> maps = compose(cube(shape, n), [](const Vector& x) -> Vector { return 2 * x - Vector::Ones(); });
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, 2), space_of(shape, order), maps, field));
    data.classes[0].geometry_coefficients = make_class(space_of(shape, 2), space_of(shape, 1), compose(maps, bend), field).geometry_coefficients;
    return data;
}

// Distance at which a ray meets a sphere around the origin first, beyond 0; NaN if it does not.
double sphere_entry(const Line& line, double radius) {
    const double middle = -line.origin.dot(line.direction);
    const double nearest = (line.origin + middle * line.direction).squaredNorm();
    const double half = std::sqrt(radius * radius - nearest);
    return middle - half > 0 ? middle - half : middle + half > 0 ? middle + half : std::nan("");
}

Camera test_camera(const Vector3& eye, double field_of_view = 40) {
    Camera camera;
    camera.eye = eye;
    camera.up = {0.1, 0.2, 1};
    camera.field_of_view = field_of_view;
    return camera;
}

} // namespace

TEST_CASE("the oracle finds spheres where they are") {
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Model model(bent_cube(shape, 2, 2, [](const Vector& x) { return x; }, [](const Vector& x) { return x.squaredNorm(); }));
        // From outside, and from within the inner sphere.
        for (const Vector3& eye : {Vector3{2, 1.5, 1.2}, Vector3{0.1, -0.2, 0.15}}) {
            const Camera camera = test_camera(eye, 70);
            const IsosurfacePicture picture = draw_isosurface(model, {scalar_of_field(model.volume, 0), {0.25, 0.81}}, camera, 40, 40);
            std::size_t n_wrong = 0, n_hits = 0;
            double depth_error = 0, normal_error = 0;
            for (std::uint32_t pixel = 0; pixel < 1600; ++pixel) {
                const Line line = line_of(pixel_ray(camera, 40, 40, pixel % 40, pixel / 40));
                double t = sphere_entry(line, 0.9);
                const double inner = sphere_entry(line, 0.5);
                const bool is_inner = std::isnan(t) || inner < t;
                if (is_inner)
                    t = inner;
                const std::optional<Crossing>& crossing = picture.answers[pixel].crossing;
                n_wrong += crossing.has_value() == std::isnan(t);
                if (!crossing || std::isnan(t))
                    continue;
                ++n_hits;
                n_wrong += crossing->value != (is_inner ? 0 : 1);
                const Vector x = line.at(t);
                depth_error = std::max(depth_error, std::abs(crossing->t - t) * crossing->facing);
                // From outside normals point outwards.
                const Vector normal = x.dot(line.direction) < 0 ? x.normalized() : Vector(-x.normalized());
                normal_error = std::max(normal_error, (crossing->normal - normal).norm() * crossing->facing);
            }
            CAPTURE(native::name(shape), eye[0], n_hits);
            CHECK(n_hits > 100);
            CHECK(n_wrong == 0);
            CHECK(depth_error < 1e-14);
            CHECK(normal_error < 1e-13);
            CHECK(picture.n_failures == 0);
        }
    }
}

TEST_CASE("the oracle's ways to find roots agree", "[isosurface]") {
    std::size_t n_hits = 0, n_rays = 0, n_failures = 0;
    double worst = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const RandomVolume random = random_volume(seed);
        const Model model(random.data);
        IsosurfaceTracer tracer(model, {scalar_of_field(model.volume, 0), random.values, random.clip});
        for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
            const Line line = line_of(pixel_ray(random.camera, 10, 10, pixel % 10, pixel / 10));
            const RayAnswer by_series = tracer.first(line);
            ++n_rays;
            n_hits += by_series.crossing.has_value();
            for (const RootFinder finder : {RootFinder::samples, RootFinder::companion}) {
                const RayAnswer other = tracer.first(line, finder);
                CAPTURE(seed, pixel, random.description, static_cast<int>(finder), by_series.margin, other.margin);
                REQUIRE(other.crossing.has_value() == by_series.crossing.has_value());
                if (!other.crossing)
                    continue;
                CHECK(other.crossing->element == by_series.crossing->element);
                const double slope = by_series.crossing->facing * by_series.crossing->slope;
                const double off = std::abs(other.crossing->t - by_series.crossing->t);
                worst = std::max(worst, off * std::min(1.0, slope / tracer.range() * model.diagonal) / model.diagonal);
                CHECK(off * slope <= 1e-12 * tracer.range());
            }
        }
        n_failures += tracer.n_failures();
    }
    WARN(n_hits << " hits of " << n_rays << " rays, apart by at most " << worst << " of the volume");
    CHECK(n_hits > 500);
    CHECK(n_failures == 0);
}

} // namespace elvis::oracle
