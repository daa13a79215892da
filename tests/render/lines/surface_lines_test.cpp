// Lines on curved surfaces and on faces against dense samples of each pixel's square.
#include <core/oracle/picture/ray.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr std::uint32_t surface_picture_size = 120;

FrameRequest view() {
    FrameRequest request;
    request.width = request.height = surface_picture_size;
    request.camera.eye = {2.1, 1.7, 1.4};
    request.camera.look_at = {0.5, 0.5, 0.5};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    return request;
}

VolumeData cube_volume(int n) {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1),
                                      cube(Shape::hexahedron, n), [](const Vector& x) { return x.z() + 0.3 * x.x(); }));
    return data;
}

struct Counts {
    std::size_t marked = 0, undecided = 0, hit = 0;
    /** Not marked where samples in the square tell a line; marked where samples of a square a fiftieth larger tell none. */
    std::size_t missed = 0, invented = 0;
};

// `see`: what a ray sees, nothing where it misses; a line runs between samples that see different things, or values of both
// signs.
Counts compare_lines(const FrameRequest& request, const Frame& frame, std::uint32_t yes, std::uint32_t open,
                     const std::function<std::optional<double>(const Ray&)>& see, bool by_sign) {
    constexpr int coarse = 12, fine = 240;
    Counts counts;
    const auto tells = [&](std::uint32_t column, std::uint32_t row, long double width, int n) {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const auto seen = see(pixel_ray(request.camera, surface_picture_size, surface_picture_size,
                                                column + width * (i / static_cast<long double>(n) - 0.5L),
                                                row + width * (j / static_cast<long double>(n) - 0.5L)));
                if (seen) {
                    least = std::min(least, *seen);
                    most = std::max(most, *seen);
                }
            }
        return by_sign ? least < 0 && most > 0 : least < most;
    };
    for (std::uint32_t row = 0; row < surface_picture_size; ++row)
        for (std::uint32_t column = 0; column < surface_picture_size; ++column) {
            const std::size_t pixel = std::size_t{row} * surface_picture_size + column;
            if (frame.element[pixel] < 0 ||
                !see(pixel_ray(request.camera, surface_picture_size, surface_picture_size, column, row)))
                continue;
            const bool is_marked = (frame.flags[pixel] & yes) != 0, is_open = (frame.flags[pixel] & open) != 0;
            counts.hit += 1;
            counts.marked += is_marked ? 1 : 0;
            counts.undecided += is_open ? 1 : 0;
            counts.missed += !is_marked && !is_open && tells(column, row, 0.999L, coarse) ? 1 : 0;
            // Slivers at silhouettes take many samples.
            counts.invented += is_marked && !tells(column, row, 1.02L, coarse) && !tells(column, row, 1.02L, fine) ? 1 : 0;
        }
    return counts;
}

void report(const char* name, const Counts& counts) {
    WARN(name << ": " << counts.marked << " of " << counts.hit << " pixels marked, " << counts.undecided << " undecided, "
              << counts.missed << " missed, " << counts.invented << " invented");
    CHECK(counts.missed == 0);
    CHECK(counts.invented == 0);
    CHECK(counts.marked > 60);
}

// Distance to the first crossing with a sphere, on the outside of which the eye is.
std::optional<LongVector> sphere_point(const Ray& ray, const LongVector& centre, long double radius) {
    const LongVector to = centre - ray.origin;
    const long double along = to.dot(ray.direction), square = radius * radius - (to.squaredNorm() - along * along);
    if (square < 0)
        return std::nullopt;
    return ray.origin + (along - std::sqrt(square)) * ray.direction;
}

// The point of the unit cube that a ray meets first.
std::optional<LongVector> cube_point(const Ray& ray) {
    long double enter = 0, leave = std::numeric_limits<long double>::infinity();
    for (Eigen::Index d = 0; d < 3; ++d) {
        const long double a = -ray.origin[d] / ray.direction[d], b = (1 - ray.origin[d]) / ray.direction[d];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave)
        return std::nullopt;
    return ray.origin + enter * ray.direction;
}

/** A sphere with a contour of z + 0.3 x and with mesh lines. */
FrameRequest sphere_view() {
    FrameRequest request = view();
    Surface surface;
    surface.geometry = CutShape{Sphere{{0.5, 0.5, 0.5}, 0.4}};
    surface.colors.points = {{0, {0, 0, 0}}, {2, {1, 1, 1}}};
    surface.contours = Contours{{0.7}, {}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    return request;
}

std::optional<LongVector> on_sphere(const Ray& ray) { return sphere_point(ray, LongVector(0.5L, 0.5L, 0.5L), 0.4L); }

/** What is zero on the contour. */
std::optional<double> contour_on_sphere(const Ray& ray) {
    const auto x = on_sphere(ray);
    return x ? std::optional(static_cast<double>(x->z() + 0.3L * x->x() - 0.7L)) : std::nullopt;
}

std::optional<double> element_on_sphere(const Ray& ray) {
    const auto x = on_sphere(ray);
    return x ? std::optional(
                   static_cast<double>(std::floor(4 * x->x()) + 10 * std::floor(4 * x->y()) + 100 * std::floor(4 * x->z())))
             : std::nullopt;
}

/** What is seen of the sphere's front. */
std::function<std::optional<double>(const Ray&)> from_near(long double near, std::optional<double> (*see)(const Ray&)) {
    return [near, see](const Ray& ray) {
        const auto x = on_sphere(ray);
        return x && (*x - ray.origin).norm() > near ? see(ray) : std::nullopt;
    };
}

} // namespace

TEST_CASE("lines on a sphere begin at the camera's near, or are marked undecided there") {
    const TemporaryFile file("near_lines.h5");
    write_volume(file.path(), cube_volume(4));
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request = sphere_view();
    Renderer renderer(device(), volume, Precision::float32);
    // The sphere's front is 1.76 to 2.1 away: these cut it along many directions.
    for (const double near : {1.8, 1.83, 1.86}) {
        request.camera.near = near;
        const Frame frame = renderer.render(request);
        INFO("near " << near);
        const Counts contours = compare_lines(request, frame, pixel_flag::contour, pixel_flag::contour_undecided,
                                              from_near(near, contour_on_sphere), true);
        report("contours", contours);
        CHECK(contours.undecided <= contours.hit / 50);
        const Counts lines = compare_lines(request, frame, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided,
                                           from_near(near, element_on_sphere), false);
        report("mesh lines", lines);
        CHECK(lines.undecided <= lines.hit / 20);
    }
}

TEST_CASE("lines on a sphere are those of its points, or marked undecided") {
    const TemporaryFile file("sphere_lines.h5");
    write_volume(file.path(), cube_volume(4));
    const RuntimeVolume volume = open_volume(file.path());
    const FrameRequest request = sphere_view();
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        const Counts contours =
            compare_lines(request, frame, pixel_flag::contour, pixel_flag::contour_undecided, contour_on_sphere, true);
        report("contours on a sphere", contours);
        // Where the surface is seen edge on.
        CHECK(contours.undecided <= contours.hit / 10);
        const Counts lines =
            compare_lines(request, frame, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided, element_on_sphere, false);
        report("mesh lines on a sphere", lines);
        CHECK(lines.undecided <= lines.hit / 8);
    }
}

TEST_CASE("lines on the boundary of a box are those of its faces, or marked undecided") {
    const TemporaryFile file("box_lines.h5");
    generate(R"({"generator": 1, "mesh": "box", "shape": "hexahedron", "box": [[0, 0, 0], [1, 1, 1]], "elements": [4, 4, 4],
                 "order": 2, "field": "sphere"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request = view();
    Surface surface;
    surface.geometry = BoundaryFaces{};
    surface.colors.points = {{0, {0, 0, 0}}, {2, {1, 1, 1}}};
    surface.contours = Contours{{1.7}, {}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        const Counts contours = compare_lines(
            request, frame, pixel_flag::contour, pixel_flag::contour_undecided,
            [&](const Ray& ray) -> std::optional<double> {
                const auto x = cube_point(ray);
                return x ? std::optional(static_cast<double>(x->squaredNorm() - 1.7L)) : std::nullopt;
            },
            true);
        report("contours on a box", contours);
        // Where the surface is seen edge on.
        CHECK(contours.undecided <= contours.hit / 10);
        const Counts lines = compare_lines(
            request, frame, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided,
            [&](const Ray& ray) -> std::optional<double> {
                const auto x = cube_point(ray);
                // Beyond the silhouette, which is made of edges.
                if (!x)
                    return -1;
                // The face, and the element on it.
                double place = 0;
                for (Eigen::Index d = 0; d < 3; ++d) {
                    const bool is_on = std::abs((*x)[d]) < 1e-12L || std::abs((*x)[d] - 1) < 1e-12L;
                    place = 10 * place + (is_on ? 7 : static_cast<double>(std::floor(4 * (*x)[d])));
                }
                return place;
            },
            false);
        report("mesh lines on a box", lines);
        CHECK(lines.undecided <= lines.hit / 8);
    }
}

namespace {

// Undecided pixels with every limit, which must fall, while none is wrong. `sees_contour`, `sees_mesh`: as in compare_lines.
void check_limits(const char* name, FrameRequest request, const RuntimeVolume& volume,
                  const std::function<std::optional<double>(const Ray&)>& sees_contour,
                  const std::function<std::optional<double>(const Ray&)>& sees_mesh) {
    Renderer renderer(device(), volume, Precision::float64);
    std::vector<Counts> contours, lines;
    for (std::uint32_t limit = 0; limit <= 8; limit += 2) {
        request.surfaces[0].subdivisions = limit;
        const Frame frame = renderer.render(request);
        contours.push_back(
            compare_lines(request, frame, pixel_flag::contour, pixel_flag::contour_undecided, sees_contour, true));
        CHECK(contours.back().missed == 0);
        CHECK(contours.back().invented == 0);
        lines.push_back(
            compare_lines(request, frame, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided, sees_mesh, false));
        CHECK(lines.back().missed == 0);
        CHECK(lines.back().invented == 0);
    }
    const auto undecided = [](const std::vector<Counts>& counts) {
        std::string text;
        for (const Counts& count : counts)
            text.append(" ").append(std::to_string(count.undecided));
        return text;
    };
    WARN(name << ", undecided with 0, 2, 4, 6, 8 subdivisions, of " << contours[0].hit << " pixels: contours"
              << undecided(contours) << "; mesh lines" << undecided(lines));
    for (const std::vector<Counts>& counts : {contours, lines}) {
        for (std::size_t i = 1; i < counts.size(); ++i)
            CHECK(counts[i].undecided <= counts[i - 1].undecided);
        CHECK(4 * counts[2].undecided <= counts[0].undecided);
        // Of few pixels half may be one more.
        CHECK(2 * counts[4].undecided <= counts[2].undecided + 1);
    }
    CHECK(contours[4].undecided <= contours[4].hit / 1000);
    CHECK(lines[4].undecided <= lines[4].hit / 200);
}

} // namespace

TEST_CASE("more subdivision leaves fewer pixels undecided on a sphere, at its silhouette, too") {
    const TemporaryFile file("sphere_limits.h5");
    write_volume(file.path(), cube_volume(4));
    check_limits("sphere", sphere_view(), open_volume(file.path()), contour_on_sphere, element_on_sphere);
}

TEST_CASE("more subdivision leaves fewer pixels undecided on the boundary of a ball, at its silhouette, too") {
    // Of an order by which mapping and field are off by far less than a pixel.
    const TemporaryFile file("ball_limits.h5");
    generate(R"({"generator": 1, "mesh": "ball", "shape": "hexahedron", "elements": [4, 4, 4], "geometry_order": 6, "order": 8,
                 "field": "waves"})",
             file.path());
    FrameRequest request = view();
    request.camera.eye = {3.2, 2.4, 1.8};
    request.camera.look_at = {0, 0, 0};
    Surface surface;
    surface.geometry = BoundaryFaces{};
    surface.colors.points = {{0, {0, 0, 0}}, {2, {1, 1, 1}}};
    surface.contours = Contours{{0.45}, {}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    check_limits(
        "ball", request, open_volume(file.path()),
        [](const Ray& ray) -> std::optional<double> {
            const auto point = sphere_point(ray, LongVector(0, 0, 0), 1);
            if (!point)
                return std::nullopt;
            const LongVector x = 3.5L * *point;
            return static_cast<double>(std::sin(x.x()) * std::cos(x.y()) + std::sin(x.y()) * std::cos(x.z()) +
                                       std::sin(x.z()) * std::cos(x.x()) - 0.45L);
        },
        [](const Ray& ray) -> std::optional<double> {
            const auto point = sphere_point(ray, LongVector(0, 0, 0), 1);
            if (!point)
                return std::nullopt;
            // The side of the cube, and the element there: angles are equidistant.
            Eigen::Index side = 0;
            const long double most = point->cwiseAbs().maxCoeff(&side);
            double place = static_cast<double>((*point)[side] > 0 ? 2 * side : 2 * side + 1);
            for (Eigen::Index d = 0; d < 3; ++d) {
                const long double angle = 4 / 3.14159265358979323846L * std::atan((*point)[d] / most);
                place = d == side ? place : 4 * place + static_cast<double>(std::floor(2 * (angle + 1)));
            }
            return place;
        });
}

} // namespace elvis::oracle
