// The oracle on cases whose answers are known.
#include <core/oracle/picture/color.hpp>
#include <core/oracle/picture/picture.hpp>
#include <core/oracle/samples/exact_volumes.hpp>
#include <core/oracle/samples/meshes.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

const std::array<Shape, 4> shapes{Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron};

double squared_norm(const Vector& x) { return x.squaredNorm(); }

FrameRequest request_of(const Vector3& eye, const CutPlane& plane, std::uint32_t size, double height) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera.orthographic = true;
    request.camera.eye = eye;
    request.camera.up = {0, 0, 1};
    request.camera.height = height;
    Surface surface;
    surface.colors.points = {{0, {0, 0, 0}}, {10, {1, 1, 1}}};
    surface.geometry = plane;
    request.surfaces = {surface};
    return request;
}

// Points spread over the reference shape, faces included now and then.
std::vector<Vector> random_points(Shape shape, std::size_t count, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::uniform_int_distribution<int> die(0, 9);
    std::vector<Vector> points;
    while (points.size() < count) {
        Vector xi(uniform(random), uniform(random), uniform(random));
        if (die(random) == 0)
            xi[die(random) % 3] = -1;
        if (excess(shape, xi) <= 0)
            points.push_back(xi);
    }
    return points;
}

// A smooth bend that keeps the Jacobian positive; cubic in xi.
Vector bend(const Vector& xi) {
    return {xi.x() + 0.12 * xi.y() * xi.y() - 0.08 * xi.z() * xi.x(), xi.y() + 0.1 * xi.z() * xi.z() * xi.x(),
            1.5 * xi.z() - 0.15 * xi.x() * xi.y() + 0.05 * xi.x() * xi.x() * xi.x()};
}

} // namespace

TEST_CASE("a sphere field in a box is drawn exactly") {
    const auto maps = boxes({-1, -1, -2}, {1, 1, 4}, {4, 4, 6});
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 2), maps, squared_norm));
    const Model model(std::move(data));
    FrameRequest request = request_of({3, 4, 5}, {{0.3, 0.25, 1, -0.4}}, 120, 8);
    request.camera.orthographic = false;
    const Picture picture = draw(model, request);

    double largest_error = 0;
    std::size_t n_inside = 0;
    for (std::size_t pixel = 0; pixel < picture.value.size(); ++pixel) {
        const Vector& x = picture.position[pixel];
        const bool is_inside = std::abs(x.x()) <= 1 && std::abs(x.y()) <= 1 && x.z() >= -2 && x.z() <= 4;
        REQUIRE(is_inside == (picture.is_inside[pixel] != 0));
        if (!is_inside)
            continue;
        ++n_inside;
        largest_error = std::max(largest_error, std::abs(picture.value[pixel] - x.squaredNorm()));
        REQUIRE(std::abs(0.3 * x.x() + 0.25 * x.y() + x.z() - 0.4) < 1e-14);
        REQUIRE(std::abs((x - Vector(3, 4, 5)).norm() - picture.depth[pixel]) < 1e-13);
        const auto cell = [&](double value, double low, double size) { return static_cast<int>((value - low) / size); };
        REQUIRE(picture.element[pixel] == cell(x.x(), -1, 0.5) + 4 * (cell(x.y(), -1, 0.5) + 4 * cell(x.z(), -2, 1)));
    }
    INFO("largest error " << largest_error << " over " << n_inside << " pixels");
    CHECK(n_inside > 800);
    CHECK(largest_error < 1e-13);
    CHECK(picture.counts.unresolved == 0);
}

TEST_CASE("on a plane in element faces the viewer's side wins, then the lowest number") {
    // A value of its own in each of 2 x 2 x 2 cubes. Pixel centres of an odd-sized picture lie on the cubes' edges, too.
    VolumeData data;
    const auto maps = boxes({-1, -1, -1}, {1, 1, 1}, {2, 2, 2});
    ClassData elements =
        make_class(space_of(Shape::hexahedron, 1), {Shape::hexahedron, native::Basis::modified, {0, 0, 0}}, maps,
                   [](const Vector& x) { return (x.x() > 0 ? 1 : 0) + (x.y() > 0 ? 2 : 0) + (x.z() > 0 ? 4 : 0); });
    data.classes.push_back(std::move(elements));
    const Model model(std::move(data));
    for (const double side : {-1.0, 1.0}) {
        const Picture picture = draw(model, request_of({3 * side, 0, 0}, {{1, 0, 0, 0}}, 51, 3));
        std::size_t n_on_edges = 0;
        for (std::size_t pixel = 0; pixel < picture.value.size(); ++pixel) {
            if (picture.is_inside[pixel] == 0)
                continue;
            const Vector& x = picture.position[pixel];
            n_on_edges += x.y() == 0 || x.z() == 0;
            const int expected = (side > 0 ? 1 : 0) + (x.y() > 1e-12 ? 2 : 0) + (x.z() > 1e-12 ? 4 : 0);
            REQUIRE(std::abs(picture.value[pixel] - expected) < 1e-14);
            REQUIRE(picture.element[pixel] == expected);
        }
        CHECK(n_on_edges > 30);
        // The other side of the plane could be chosen everywhere.
        CHECK(picture.alternatives.size() >= 1000);
    }
}

TEST_CASE("points of curved elements are found where they came from") {
    std::mt19937_64 random(7);
    for (const Shape shape : shapes) {
        VolumeData data;
        data.classes.push_back(make_class(space_of(shape, 3), space_of(shape, 1), {bend}, squared_norm));
        const Model model(std::move(data));
        REQUIRE_FALSE(model.enclosures[0].is_folded);
        Inverter inverter(model.volume, model.enclosures);
        double largest_error = 0;
        for (const Vector& xi : random_points(shape, 300, random)) {
            const auto solutions = inverter.find(0, model.volume.position(0, xi), inside_tolerance);
            REQUIRE(solutions.size() == 1);
            largest_error = std::max(largest_error, (solutions[0].xi - xi).lpNorm<Eigen::Infinity>());
        }
        CAPTURE(native::name(shape), largest_error);
        CHECK(largest_error < 1e-12);
        CHECK(inverter.counts().unresolved == 0);
    }
}

TEST_CASE("points just outside curved elements are not inside") {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const Shape shape : shapes) {
        VolumeData data;
        data.classes.push_back(make_class(space_of(shape, 3), space_of(shape, 1), {bend}, squared_norm));
        const Model model(std::move(data));
        Inverter inverter(model.volume, model.enclosures);
        const auto faces = face_constraints(shape);
        std::size_t n = 0;
        for (Vector xi : random_points(shape, 400, random)) {
            // Onto a face, then out by 1e-8 to 0.1; near edges that may be outside of another face only.
            const FaceConstraint& face = faces[n++ % faces.size()];
            xi += (face.offset - face.normal.dot(xi)) / face.normal.squaredNorm() * face.normal;
            xi += std::pow(10.0, -1 - 7 * uniform(random)) * face.normal;
            const auto solutions = inverter.find(0, model.volume.position(0, xi), inside_tolerance);
            CAPTURE(native::name(shape), xi.transpose());
            REQUIRE(solutions.empty());
        }
        CHECK(inverter.counts().subdivided > 50);
        CHECK(inverter.counts().unresolved == 0);
    }
}

TEST_CASE("meshes of every shape fill the bent cube without gaps or overlaps") {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    VolumeData mixed = mixed_volume(3, 2, squared_norm);
    std::vector<VolumeData> volumes{std::move(mixed)};
    for (const Shape shape : shapes) {
        VolumeData data;
        data.classes.push_back(
            make_class(space_of(shape, 2), space_of(shape, 4), compose(cube(shape, 2), quadratic_bend), squared_norm));
        volumes.push_back(std::move(data));
    }
    for (VolumeData& data : volumes) {
        const Model model(std::move(data));
        for (const Enclosure& enclosure : model.enclosures)
            REQUIRE_FALSE(enclosure.is_folded);
        Inverter inverter(model.volume, model.enclosures);
        for (int i = 0; i < 500; ++i) {
            const Vector x = quadratic_bend({uniform(random), uniform(random), uniform(random)});
            const auto candidates = locate(model, inverter, x, {1, 0, 0}, 0);
            CAPTURE(x.transpose());
            REQUIRE(candidates.size() == 1);
        }
        CHECK(inverter.counts().unresolved == 0);
    }
}

TEST_CASE("every solution in an element with negative Jacobians is found") {
    struct Case {
        Vector displacement;
        bool overlaps;
    };
    // Both fold; the first turns inside out without covering a point twice.
    for (const Case& c : {Case{{0, 0, 0.6}, false}, Case{{0.6, 0, 0}, true}}) {
        VolumeData data;
        data.classes.push_back(make_class(space_of(Shape::tetrahedron, 2), space_of(Shape::tetrahedron, 1),
                                          {twisted_tetrahedron(c.displacement)}, squared_norm));
        const Model model(std::move(data));
        REQUIRE(model.enclosures[0].is_folded);
        Inverter inverter(model.volume, model.enclosures);
        std::mt19937_64 random(9);
        std::size_t n_double = 0;
        for (const Vector& xi : random_points(Shape::tetrahedron, 500, random)) {
            const Vector x = model.volume.position(0, xi);
            const auto solutions = inverter.find(0, x, inside_tolerance);
            n_double += solutions.size() > 1;
            // Next to the fold a solution moves by the root of rounding.
            const bool has_it = std::any_of(solutions.begin(), solutions.end(),
                                            [&](const Solution& s) { return (s.xi - xi).lpNorm<Eigen::Infinity>() < 1e-6; });
            CAPTURE(xi.transpose());
            REQUIRE(has_it);
            for (const Solution& s : solutions)
                REQUIRE((model.volume.position(0, s.xi) - x).norm() < 1e-13);
        }
        CHECK((n_double > 50) == c.overlaps);
        CHECK((n_double > 0) == c.overlaps);
        CHECK(inverter.counts().unresolved == 0);
    }
}

TEST_CASE("a colour table has its ends, steps and special colours") {
    ColorTable table;
    table.points = {{0, {0, 0, 0}}, {1, {1, 0.5, 0}}, {1, {0, 1, 0}}, {3, {0, 0, 1}}};
    table.below = {0.1, 0.1, 0.1, 1};
    table.above = {0.2, 0.2, 0.2, 1};
    table.nan = {1, 0, 1, 1};
    CHECK(color_of(table, -0.1) == table.below);
    CHECK(color_of(table, 3.1) == table.above);
    CHECK(color_of(table, std::nan("")) == table.nan);
    CHECK(color_of(table, 0.5) == Color{0.5, 0.25, 0, 1});
    CHECK(color_of(table, 1) == Color{0, 1, 0, 1});
    CHECK(color_of(table, 2) == Color{0, 0.5, 0.5, 1});
    CHECK(color_of(table, 3) == Color{0, 0, 1, 1});
}

TEST_CASE("the distance to the domain's edge is bounded by its decade") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1),
                                      boxes({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), squared_norm));
    const Model model(std::move(data));
    Inverter inverter(model.volume, model.enclosures);
    CHECK(distance_to_edge(model, inverter, {0.5, 0.5, 1 - 2e-6}) == Approx(1e-5));
    CHECK(distance_to_edge(model, inverter, {0.5, 0.5, 1 + 2e-6}) == Approx(1e-5));
    CHECK(std::isinf(distance_to_edge(model, inverter, {0.5, 0.5, 0.5})));
}

} // namespace elvis::oracle
