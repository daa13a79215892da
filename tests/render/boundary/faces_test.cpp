// Two-dimensional volumes and boundaries, whose pictures are known in closed form.
#include <core/accuracy/face_accuracy.hpp>
#include <core/oracle/picture/ray.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

using native::Shape;

// The square [-1,1]^2, n cells a side, each a quadrilateral or two triangles, as maps into the plane z = 0.
std::vector<Map> square(Shape shape, int n) {
    std::vector<Map> maps;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto at = [=](double u, double v) -> Vector { return {-1 + 2 * (i + u) / n, -1 + 2 * (j + v) / n, 0}; };
            if (shape == Shape::quadrilateral) {
                maps.push_back([=](const Vector& xi) { return at((1 + xi.x()) / 2, (1 + xi.y()) / 2); });
            } else {
                maps.push_back([=](const Vector& xi) { return at((1 + xi.x()) / 2, (1 + xi.y()) / 2); });
                maps.push_back([=](const Vector& xi) { return at((1 - xi.x()) / 2, (1 - xi.y()) / 2); });
            }
        }
    return maps;
}

// z = bend (x^2 + y^2): rays meet it up to twice.
double crossing(const Ray& ray, double bend) {
    const auto& o = ray.origin;
    const auto& d = ray.direction;
    const auto inside = [&](long double t) {
        return t > 0 && std::abs(o.x() + t * d.x()) <= 1 && std::abs(o.y() + t * d.y()) <= 1;
    };
    const long double a = bend * (d.x() * d.x() + d.y() * d.y());
    const long double b = 2 * bend * (o.x() * d.x() + o.y() * d.y()) - d.z();
    const long double c = bend * (o.x() * o.x() + o.y() * o.y()) - o.z();
    std::vector<long double> roots;
    if (a == 0) {
        roots = {-c / b};
    } else if (const long double discriminant = b * b - 4 * a * c; discriminant >= 0) {
        roots = {(-b - std::sqrt(discriminant)) / (2 * a), (-b + std::sqrt(discriminant)) / (2 * a)};
        std::sort(roots.begin(), roots.end());
    }
    for (const long double t : roots)
        if (inside(t))
            return static_cast<double>(t);
    return std::nan("");
}

double field_of(const Vector& x) { return 1 + x.x() - 0.5 * x.y() + 0.3 * x.x() * x.x() * x.y(); }

void check(Shape shape, double bend, const Vector3& eye) {
    VolumeData data;
    const auto bent = [bend](const Vector& x) -> Vector { return {x.x(), x.y(), bend * (x.x() * x.x() + x.y() * x.y())}; };
    data.classes.push_back(
        make_class(space_of(shape, bend == 0 ? 1 : 2), space_of(shape, 4), compose(square(shape, 3), bent), field_of));
    const TemporaryFile file("surface.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = request.height = 150;
    request.camera.eye = eye;
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    request.surfaces = {Surface{FlatElements{}}};
    request.surfaces[0].colors.points = {{-2, {0, 0, 0}}, {3, {1, 1, 1}}};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        double value_error = 0, depth_error = 0, normal_error = 0;
        std::size_t hits = 0, disagreements = 0, undecided = 0;
        for (std::uint32_t row = 0; row < request.height; ++row)
            for (std::uint32_t column = 0; column < request.width; ++column) {
                const std::size_t pixel = row * request.width + column;
                const Ray ray = pixel_ray(request.camera, request.width, request.height, column, row);
                const double t = crossing(ray, bend);
                if (std::isnan(t) != (frame.element[pixel] < 0)) {
                    ++disagreements;
                    continue;
                }
                if (std::isnan(t))
                    continue;
                ++hits;
                // At the mesh's edge rounding may decide between two crossings.
                if ((frame.flags[pixel] & pixel_flag::undecided) != 0) {
                    ++undecided;
                    continue;
                }
                const Vector x = (ray.origin + t * ray.direction).cast<double>();
                const Vector gradient = Vector(-2 * bend * x.x(), -2 * bend * x.y(), 1).normalized();
                const double facing = std::abs(gradient.dot(ray.direction.cast<double>()));
                const Vector normal(frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]);
                // Grazing rays stretch every error.
                depth_error = std::max(depth_error, std::abs(frame.depth[pixel] - t) * facing);
                value_error = std::max(value_error, std::abs(frame.value[pixel] - field_of(x)) * facing);
                normal_error = std::max(normal_error, 1 - std::abs(normal.dot(gradient)));
                CHECK(normal.dot(ray.direction.cast<double>()) <= 0);
            }
        const bool is_single = precision == Precision::float32;
        WARN(native::name(shape) << (bend == 0 ? ", flat" : ", bent") << (is_single ? ", float32: " : ", float64: ") << hits
                                 << " hits, depth error " << depth_error << ", value error " << value_error << ", normal error "
                                 << normal_error << ", " << disagreements << " disagreements, " << undecided << " undecided");
        CHECK(undecided <= 3);
        CHECK(hits > 1000);
        CHECK(disagreements <= (is_single ? 1 : 0));
        CHECK(depth_error <= (is_single ? 3e-6 : 1e-14));
        CHECK(value_error <= (is_single ? 5e-6 : 1e-13));
        CHECK(normal_error <= (is_single ? 1e-6 : 1e-14));
        // Rays that touch the surface: flagged, because rounding decides whether they meet it.
        CHECK(frame.counts.newton_failures <= (is_single && bend != 0 ? 5 : 0));
        CHECK(frame.counts.work_limit_pixels == 0);
    }
}

// Distance at which a ray enters the cube [-1,1]^3; NaN if it does not.
double cube_entry(const Ray& ray) {
    long double enter = 0, leave = 1e30L;
    for (int axis = 0; axis < 3; ++axis) {
        const long double one = (-1 - ray.origin[axis]) / ray.direction[axis];
        const long double other = (1 - ray.origin[axis]) / ray.direction[axis];
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    return enter <= leave ? static_cast<double>(enter) : std::nan("");
}

FrameRequest boundary_view(std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera.eye = {3.1, 2.3, 1.9};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 50;
    request.surfaces = {Surface{BoundaryFaces{}}};
    request.surfaces[0].colors.points = {{-2, {0, 0, 0}}, {3, {1, 1, 1}}};
    return request;
}

} // namespace

TEST_CASE("the boundary of a box is drawn exactly, whatever shapes fill it") {
    for (const char* shape : {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"}) {
        const TemporaryFile file("box.h5");
        generate(
            std::string(R"({"generator": 1, "mesh": "box", "elements": [4, 3, 3], "order": 3, "field": "sphere", "shape": ")") +
                shape + "\"}",
            file.path());
        const RuntimeVolume volume = open_volume(file.path());
        const FrameRequest request = boundary_view(160);
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Renderer renderer(device(), volume, precision);
            const Frame frame = renderer.render(request);
            double depth_error = 0, value_error = 0;
            std::size_t disagreements = 0, hits = 0, flagged = 0;
            for (std::uint32_t row = 0; row < request.height; ++row)
                for (std::uint32_t column = 0; column < request.width; ++column) {
                    const std::size_t pixel = row * request.width + column;
                    const Ray ray = pixel_ray(request.camera, request.width, request.height, column, row);
                    const double t = cube_entry(ray);
                    flagged += frame.flags[pixel] != 0;
                    if (std::isnan(t) != (frame.element[pixel] < 0)) {
                        ++disagreements;
                    } else if (!std::isnan(t)) {
                        ++hits;
                        const Vector x = (ray.origin + t * ray.direction).cast<double>();
                        const Vector normal(frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]);
                        // Oblique rays stretch every error.
                        const double facing = std::abs(normal.dot(ray.direction.cast<double>()));
                        depth_error = std::max(depth_error, facing * std::abs(frame.depth[pixel] - t));
                        value_error = std::max(value_error, facing * std::abs(frame.value[pixel] - x.squaredNorm()));
                    }
                }
            const bool is_single = precision == Precision::float32;
            WARN("box of " << shape << (is_single ? ", float32: " : ", float64: ") << hits << " hits, depth error "
                           << depth_error << ", value error " << value_error << ", " << disagreements << " disagreements, "
                           << flagged << " flagged");
            CHECK(hits > 1000);
            CHECK(disagreements == 0);
            CHECK(depth_error <= (is_single ? 2e-5 : 1e-13));
            CHECK(value_error <= (is_single ? 4e-5 : 1e-13));
            CHECK(flagged <= 20);
        }
    }
}

TEST_CASE("a curved boundary has no holes") {
    const TemporaryFile file("ball.h5");
    generate(
        R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [4, 4, 4], "geometry_order": 3, "order": 3, "field": "waves"})",
        file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const FrameRequest request = boundary_view(200);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        // The geometry of order 3 keeps this close to the sphere.
        double off_sphere = 0;
        std::size_t missed = 0, beyond = 0;
        for (std::uint32_t row = 0; row < request.height; ++row)
            for (std::uint32_t column = 0; column < request.width; ++column) {
                const std::size_t pixel = row * request.width + column;
                const Ray ray = pixel_ray(request.camera, request.width, request.height, column, row);
                const long double middle = -ray.origin.dot(ray.direction);
                const auto nearest = static_cast<double>((ray.origin + middle * ray.direction).norm());
                const bool is_hit = frame.element[pixel] >= 0;
                missed += nearest < 0.999 && !is_hit;
                beyond += nearest > 1.001 && is_hit;
                if (nearest < 0.99 && is_hit) {
                    const Vector x = (ray.origin + frame.depth[pixel] * ray.direction).cast<double>();
                    off_sphere = std::max(off_sphere, std::abs(x.norm() - 1));
                    // In front, not behind.
                    missed += frame.depth[pixel] > static_cast<double>(middle);
                }
            }
        WARN("ball: " << missed << " pixels missed, " << beyond << " beyond, off the sphere by at most " << off_sphere << ", "
                      << frame.counts.newton_failures << " failures");
        CHECK(missed == 0);
        CHECK(beyond == 0);
        CHECK(off_sphere < 1e-3);
        CHECK(frame.counts.work_limit_pixels == 0);
    }
}

TEST_CASE("a curved boundary is where the elements put it") {
    for (const auto& [mesh, shape] :
         {std::pair{"ball", "hexahedron"}, {"ball", "pyramid"}, {"torus", "prism"}, {"torus", "tetrahedron"}}) {
        const TemporaryFile file("curved.h5");
        generate(std::string(R"({"generator": 1, "elements": [3, 3, 8], "order": 1, "field": "waves", "mesh": ")") + mesh +
                     R"(", "shape": ")" + shape + "\"}",
                 file.path());
        const RuntimeVolume volume = open_volume(file.path());
        const Volume model(read_volume(file.path()));
        const Boundary surface(model, faces_of(volume));
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            const FaceAccuracy r = measure_faces(device(), volume, surface, precision, 400, 2500, 40);
            const bool is_single = precision == Precision::float32;
            WARN(mesh << " of " << shape << (is_single ? ", float32: " : ", float64: ") << r.n_hits << " hits, depth error "
                      << r.depth_error << ", grazing " << r.grazing_error << ", " << r.n_careful << " careful, " << r.n_flagged
                      << " flagged, " << r.n_leaks << " leaks of " << r.n_edge_rays);
            CHECK(r.n_hits > 500);
            CHECK(r.depth_error <= (is_single ? 1e-5 : 1e-11));
            CHECK(r.grazing_error <= (is_single ? 1e-6 : 1e-12));
            CHECK(r.n_missed == 0);
            CHECK(r.n_invented == 0);
            CHECK(r.n_leaks == 0);
            CHECK(r.n_flagged <= 20);
        }
    }
}

TEST_CASE("a ray that enters a closed boundary leaves it") {
    for (const auto& [mesh, cells] : {std::pair{"ball", 3}, {"torus", 4}, {"box", 20}}) {
        const TemporaryFile file("closed.h5");
        generate(std::string(R"({"generator": 1, "order": 1, "field": "waves", "mesh": ")") + mesh + R"(", "elements": )" +
                     std::to_string(cells) + "}",
                 file.path());
        const RuntimeVolume volume = open_volume(file.path());
        FrameRequest request = boundary_view(100);
        request.surfaces[0].opacity = 0.5;
        request.background = {0, 0, 0, 0};
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Renderer renderer(device(), volume, precision);
            const Frame frame = renderer.render(request);
            std::size_t open = 0, hits = 0;
            for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
                // Each crossing leaves half of what is behind it.
                const double crossings = -std::log2(1 - frame.color[4 * pixel + 3]);
                hits += crossings > 0.5;
                const bool is_even = std::abs(crossings - 2 * std::round(crossings / 2)) < 1e-3;
                open += !is_even && (frame.flags[pixel] & pixel_flag::undecided) == 0;
            }
            WARN(mesh << (precision == Precision::float32 ? ", float32: " : ", float64: ") << open << " of " << hits
                      << " pixels open");
            CHECK(hits > 500);
            // Where a ray enters and leaves within rounding.
            CHECK(open <= (precision == Precision::float32 ? 2 : 0));
        }
    }
}

TEST_CASE("a flat mesh is drawn exactly") {
    check(Shape::quadrilateral, 0, {0.3, -2, 2.5});
    check(Shape::triangle, 0, {0.3, -2, 2.5});
}

TEST_CASE("a curved surface is drawn exactly, in front of itself too") {
    for (const Shape shape : {Shape::quadrilateral, Shape::triangle}) {
        check(shape, 0.5, {0.4, -2.5, 1.2});
        // From below and the side, where rays meet the surface twice.
        check(shape, 0.8, {0.3, -3, 0.3});
    }
}

} // namespace elvis::oracle
