// Pictures of the part of a volume in which conditions hold, beside closed forms.
#include <core/oracle/isosurface/isosurface.hpp>
#include <core/oracle/picture/view.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/expression/expression.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace elvis::oracle {
namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

FieldChoice expression(const RuntimeVolume& volume, const std::string& text) {
    FieldChoice choice;
    choice.expression = std::make_shared<const Expression>(text, volume.fields(), volume.dimension());
    return choice;
}

/** The cube [-1, 1]^3 with the field x^2 + y^2 + z^2. */
void write_cube(const std::string& path, const std::string& shape) {
    generate(
        R"({"generator": 1, "mesh": "box", "shape": ")" + shape +
            R"(", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [3, 3, 3], "order": 2, "geometry_order": 1, "field": "sphere"})",
        path);
}

FrameRequest request_of(const SurfaceGeometry& geometry, std::vector<Condition> conditions) {
    FrameRequest request;
    request.width = request.height = 128;
    request.camera.eye = {3.3, 2.4, 1.9};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    Surface surface;
    surface.geometry = geometry;
    surface.colors.points = {{0, {1, 0, 0}}};
    surface.colors.below = surface.colors.above = {1, 0, 0, 1};
    surface.conditions = std::move(conditions);
    request.surfaces = {surface};
    return request;
}

/** Parts of a line, ascending and apart. */
using Spans = std::vector<std::array<double, 2>>;

Spans in_cube(const Line& ray) {
    double enter = 0, leave = nothing;
    for (int axis = 0; axis < 3; ++axis) {
        const double one = (-1 - ray.origin[axis]) / ray.direction[axis], other = (1 - ray.origin[axis]) / ray.direction[axis];
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    return enter < leave ? Spans{{enter, leave}} : Spans{};
}

Spans in_ball(const Line& ray, double radius) {
    const double middle = -ray.origin.dot(ray.direction);
    const double square = radius * radius - (ray.origin.squaredNorm() - middle * middle);
    return square > 0 ? Spans{{middle - std::sqrt(square), middle + std::sqrt(square)}} : Spans{};
}

Spans common(const Spans& a, const Spans& b) {
    Spans result;
    for (const auto& one : a)
        for (const auto& other : b)
            if (std::max(one[0], other[0]) < std::min(one[1], other[1]))
                result.push_back({std::max(one[0], other[0]), std::min(one[1], other[1])});
    return result;
}

Spans without(const Spans& a) {
    Spans result;
    double from = -nothing;
    for (const auto& span : a) {
        result.push_back({from, span[0]});
        from = span[1];
    }
    result.push_back({from, nothing});
    return result;
}

struct Outcome {
    std::size_t n_hits = 0, n_flagged = 0;
    double largest_error = 0;
};

/** `depth_of`: exact depth along a ray, infinite where nothing is met. Pixels may be wrong only where they say so. */
Outcome check(const FrameRequest& request, const Frame& frame, double tolerance,
              const std::function<double(const Line&)>& depth_of) {
    Outcome outcome;
    std::size_t n_wrong = 0;
    for (std::uint32_t pixel = 0; pixel < frame.width * frame.height; ++pixel) {
        const Line ray =
            line_of(pixel_ray(request.camera, frame.width, frame.height, pixel % frame.width, pixel / frame.width));
        const double exact = depth_of(ray), found = std::isnan(frame.depth[pixel]) ? nothing : frame.depth[pixel];
        const bool is_flagged = (frame.flags[pixel] & (pixel_flag::undecided | pixel_flag::isosurface_undecided)) != 0;
        outcome.n_flagged += is_flagged;
        outcome.n_hits += found < nothing;
        const double error = exact == found ? 0 : std::abs(exact - found);
        if (!is_flagged && !(error <= tolerance)) {
            UNSCOPED_INFO("pixel " << pixel << ": " << found << " in place of " << exact);
            ++n_wrong;
        }
        outcome.largest_error = std::max(outcome.largest_error, !is_flagged && error < nothing ? error : 0.0);
    }
    CHECK(n_wrong == 0);
    return outcome;
}

Condition below(double value) { return {{}, value, false, false}; }
Condition above(double value) { return {{}, value, true, false}; }

} // namespace

TEST_CASE("what a threshold leaves of a cube is bounded by the cube and the level set, as the closed form says") {
    const TemporaryFile file("threshold.h5");
    const double radius = 1.2;
    for (const std::string shape : {"hexahedron", "tetrahedron"}) {
        write_cube(file.path(), shape);
        const RuntimeVolume volume = open_volume(file.path());
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Renderer renderer(device(), volume, precision);
            const double tolerance = precision == Precision::float64 ? 1e-12 : 2e-5;
            for (const bool is_inside : {true, false}) {
                FrameRequest request =
                    request_of(BoundaryFaces{}, {is_inside ? below(radius * radius) : above(radius * radius)});
                request.surfaces[0].field = expression(volume, "x - 2*y");
                const Frame frame = renderer.render(request);
                const Outcome outcome = check(request, frame, tolerance, [&](const Line& ray) {
                    const Spans ball = in_ball(ray, radius), left = common(in_cube(ray), is_inside ? ball : without(ball));
                    return left.empty() ? nothing : left.front()[0];
                });
                double value_error = 0;
                for (std::uint32_t pixel = 0; pixel < frame.width * frame.height; ++pixel)
                    if (!std::isnan(frame.depth[pixel])) {
                        const Vector x =
                            line_of(pixel_ray(request.camera, 128, 128, pixel % 128, pixel / 128)).at(frame.depth[pixel]);
                        value_error = std::max(value_error, std::abs(frame.value[pixel] - (x.x() - 2 * x.y())));
                    }
                WARN(shape << (is_inside ? ", inside" : ", outside") << (precision == Precision::float64 ? ", double" : "")
                           << ": " << outcome.n_hits << " pixels, " << outcome.n_flagged << " flagged; largest error of depth "
                           << outcome.largest_error << ", of the value " << value_error);
                CHECK(outcome.n_hits > 2000);
                CHECK(outcome.n_flagged < 300);
                CHECK(value_error <= 4 * tolerance);
                CHECK(frame.is_met == std::vector<bool>{true});
            }
        }
    }
}

TEST_CASE("conditions joined cut each other's level sets") {
    const TemporaryFile file("joined.h5");
    write_cube(file.path(), "prism");
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float64);
    const Condition half{expression(volume, "x - y"), 0.25, false, true};
    const FrameRequest request = request_of(BoundaryFaces{}, {above(0.81), half});
    const Frame frame = renderer.render(request);
    const Outcome outcome = check(request, frame, 1e-12, [&](const Line& ray) {
        const double at = (0.25 - ray.origin.x() + ray.origin.y()) / (ray.direction.x() - ray.direction.y());
        const bool falls = ray.direction.x() < ray.direction.y();
        const Spans side = {falls ? std::array{at, nothing} : std::array{-nothing, at}};
        const Spans left = common(common(in_cube(ray), side), without(in_ball(ray, 0.9)));
        return left.empty() ? nothing : left.front()[0];
    });
    WARN(outcome.n_hits << " pixels, " << outcome.n_flagged << " flagged; largest error of depth " << outcome.largest_error);
    CHECK(outcome.n_hits > 2000);
    CHECK(outcome.n_flagged < 300);
}

TEST_CASE("surfaces of all kinds show only points at which a condition holds") {
    const TemporaryFile file("kinds.h5");
    write_cube(file.path(), "hexahedron");
    const RuntimeVolume volume = open_volume(file.path());
    const CutPlane plane{{0.3, 0.5, 1, 0.2}};
    const Vector normal(0.3, 0.5, 1);
    const auto within = [](const Line& ray, double depth) {
        return ray.at(depth).cwiseAbs().maxCoeff() < 1 && ray.at(depth).squaredNorm() > 0.7;
    };
    const auto first = [&](const Line& ray, const Spans& spans) {
        for (const auto& span : spans)
            for (const double depth : span)
                if (within(ray, depth))
                    return depth;
        return nothing;
    };
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const double tolerance = precision == Precision::float64 ? 1e-12 : 2e-5;
        SECTION("a plane, in " + std::string(name_of(precision))) {
            const FrameRequest request = request_of(plane, {above(0.7)});
            const Outcome outcome = check(request, renderer.render(request), tolerance, [&](const Line& ray) {
                const double at = -(normal.dot(ray.origin) + 0.2) / normal.dot(ray.direction);
                return within(ray, at) ? at : nothing;
            });
            CHECK(outcome.n_hits > 1000);
            CHECK(outcome.n_flagged < 100);
        }
        SECTION("a sphere, in " + std::string(name_of(precision))) {
            Sphere sphere{{0.4, 0.3, 0.2}, 0.7};
            const Vector center(0.4, 0.3, 0.2);
            const FrameRequest request = request_of(CutShape{sphere}, {above(0.7)});
            const Outcome outcome = check(request, renderer.render(request), tolerance, [&](const Line& ray) {
                return first(ray, in_ball({ray.origin - center, ray.direction}, 0.7));
            });
            CHECK(outcome.n_hits > 1000);
            CHECK(outcome.n_flagged < 200);
        }
        SECTION("an isosurface, in " + std::string(name_of(precision))) {
            Isosurfaces isosurfaces;
            isosurfaces.field = expression(volume, "(x - 0.4)^2 + (y - 0.3)^2 + (z - 0.2)^2");
            isosurfaces.values = {0.49};
            FrameRequest request = request_of(isosurfaces, {above(0.7)});
            request.surfaces[0].field = isosurfaces.field;
            const Vector center(0.4, 0.3, 0.2);
            const Outcome outcome = check(request, renderer.render(request), tolerance, [&](const Line& ray) {
                return first(ray, in_ball({ray.origin - center, ray.direction}, 0.7));
            });
            CHECK(outcome.n_hits > 1000);
            CHECK(outcome.n_flagged < 200);
        }
    }
}

} // namespace elvis::oracle
