// The oracle for isosurfaces against closed forms, and its three ways to find roots against each other.
#include <core/oracle/isosurface/isosurface_compare.hpp>
#include <core/oracle/isosurface/root_finders.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/oracle/samples/random_volumes.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

using native::Shape;

// The cube [-1,1]^3 of cells of one shape, bent, with a field that is a function of the place before the bend.
VolumeData bent_cube(Shape shape, int n, std::uint32_t order, const std::function<Vector(const Vector&)>& bend,
                     const Function& field) {
    const std::vector<Map> maps = compose(cube(shape, n), [](const Vector& x) -> Vector { return 2 * x - Vector::Ones(); });
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, 2), space_of(shape, order), maps, field));
    data.classes[0].geometry_coefficients =
        make_class(space_of(shape, 2), space_of(shape, 1), compose(maps, bend), field).geometry_coefficients;
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
    // As a field on straight elements; as a number derived from the place on strongly curved ones.
    const Function square = [](const Vector& x) { return x.squaredNorm(); };
    const auto bend = [](const Vector& x) { return quadratic_bend(0.8 * x); };
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron})
        for (const bool is_curved : {false, true}) {
            const Model model(is_curved ? bent_cube(shape, 2, 1, bend, square)
                                        : bent_cube(
                                              shape, 2, 2, [](const Vector& x) { return x; }, square));
            const Scalar scalar = is_curved ? with_differences([](const Volume& volume, std::size_t element, const Vector& xi) {
                return volume.position(element, xi).squaredNorm();
            })
                                            : scalar_of_field(model.volume, 0);
            // From outside, and from within the inner sphere.
            for (const Vector3& eye : {Vector3{2, 1.5, 1.2}, Vector3{0.1, -0.2, 0.15}}) {
                const Camera camera = test_camera(eye, 40);
                const IsosurfacePicture picture = draw_isosurface(model, {scalar, {0.16, 0.3}}, camera, 40, 40);
                std::size_t n_wrong = 0, n_hits = 0;
                double depth_error = 0, normal_error = 0;
                for (std::uint32_t pixel = 0; pixel < 1600; ++pixel) {
                    const Line line = line_of(pixel_ray(camera, 40, 40, pixel % 40, pixel / 40));
                    double t = sphere_entry(line, std::sqrt(0.3));
                    const double inner = sphere_entry(line, 0.4);
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
                CAPTURE(native::name(shape), is_curved, eye[0], n_hits);
                CHECK(n_hits > 100);
                CHECK(n_wrong == 0);
                CHECK(depth_error < 1e-14);
                CHECK(normal_error < (is_curved ? 1e-12 : 1e-13));
                CHECK(picture.n_failures == 0);
            }
        }
}

TEST_CASE("the oracle's ways to find roots agree") {
    FinderComparison all;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const RandomVolume random = random_volume(seed);
        const Model model(random.data);
        const FinderComparison one =
            compare_finders(model, {scalar_of_field(model.volume, 0), random.values, random.clip}, random.camera, 10, 10);
        CAPTURE(seed, random.description);
        CHECK(one.n_samples_differ == 0);
        CHECK(one.n_companion_differ == 0);
        CHECK(one.n_failures == 0);
        all += one;
    }
    WARN(all.n_hits << " hits of " << all.n_rays << " rays, apart by at most " << all.samples_error << " and "
                    << all.companion_error << " of the range");
    CHECK(all.n_hits > 1000);
    CHECK(all.samples_error < 1e-13);
    CHECK(all.companion_error < 1e-13);
}

namespace {

// What a renderer without errors would give.
Frame frame_of(const IsosurfacePicture& exact, const Volume& volume, std::uint32_t size) {
    Frame frame;
    frame.width = frame.height = size;
    for (const RayAnswer& answer : exact.answers) {
        const bool is_hit = answer.crossing.has_value();
        const double nan = std::nan("");
        frame.depth.push_back(is_hit ? answer.crossing->t : nan);
        frame.element.push_back(is_hit ? volume.number(answer.crossing->element) : -1);
        frame.flags.push_back(is_hit ? pixel_flag::isosurface : 0);
        for (Eigen::Index d = 0; d < 3; ++d)
            frame.normal.push_back(is_hit ? answer.crossing->normal[d] : nan);
    }
    return frame;
}

} // namespace

TEST_CASE("wrong isosurfaces are told from those that rounding excuses") {
    constexpr std::uint32_t size = 40;
    const Model model(bent_cube(Shape::hexahedron, 2, 2, quadratic_bend, [](const Vector& x) { return x.squaredNorm(); }));
    IsosurfaceTracer tracer(model, {scalar_of_field(model.volume, 0), {0.5}});
    const Camera camera = test_camera({2.5, 1.5, 1.2});
    const IsosurfacePicture exact = draw_isosurface(model, tracer.isosurface(), camera, size, size);
    const Frame right = frame_of(exact, model.volume, size);
    const auto compared = [&](const Frame& frame, const IsosurfaceTolerance& tolerance) {
        return compare(tracer, exact, camera, frame, tolerance);
    };
    const IsosurfaceComparison good = compared(right, float64_tolerance);
    const std::size_t n_hits = good.n_hits;
    CHECK(n_hits > 300);
    CHECK(good.n_agree == size * size);
    CHECK(good.depth_error == 0);
    CHECK(good.normal_error == 0);
    CHECK(good.n_other_element + good.n_wrong_masks == 0);

    Frame rounded = right;
    for (double& depth : rounded.depth)
        depth = static_cast<float>(depth);
    CHECK(compared(rounded, float32_tolerance).n_agree == size * size);
    const IsosurfaceComparison coarse = compared(rounded, float64_tolerance);
    // A depth that is off may still be within rounding of the surface where rays graze it, but only there.
    CHECK(coarse.n_wrong + coarse.n_wrong_grazing > n_hits - 5);

    Frame missing = right, flagged = right, invented = right, behind = right, tilted = right;
    std::size_t n_grazing = 0, n_invented = 0;
    for (std::size_t pixel = 0; pixel < right.depth.size(); ++pixel) {
        const std::optional<Crossing>& crossing = exact.answers[pixel].crossing;
        if (!crossing) {
            if (++n_invented <= 10) {
                invented.element[pixel] = 0;
                invented.depth[pixel] = 2.5;
            }
            continue;
        }
        n_grazing += crossing->facing < grazing;
        missing.element[pixel] = flagged.element[pixel] = -1;
        flagged.flags[pixel] = pixel_flag::isosurface_undecided;
        // The far side of the surface, from within.
        behind.depth[pixel] += 2 * crossing->facing / crossing->slope;
        for (std::size_t d = 0; d < 3; ++d)
            tilted.normal[3 * pixel + d] += d == 0 ? 1e-4 : 0;
    }
    for (const IsosurfaceTolerance& tolerance : {float32_tolerance, float64_tolerance}) {
        const IsosurfaceComparison none = compared(missing, tolerance);
        CHECK(none.n_wrong + none.n_wrong_grazing + none.n_rounding == n_hits);
        CHECK(none.n_wrong >= n_hits - n_grazing - 2);
        CHECK(none.n_wrong_masks == n_hits);
        const IsosurfaceComparison said = compared(flagged, tolerance);
        CHECK(said.n_wrong == 0);
        CHECK(said.n_wrong_flagged + said.n_rounding == n_hits);
        CHECK(compared(invented, tolerance).n_wrong + compared(invented, tolerance).n_wrong_grazing == 10);
        CHECK(compared(behind, tolerance).n_wrong >= n_hits - n_grazing - 2);
        CHECK(compared(tilted, tolerance).normal_error == Approx(1e-4));
    }
}

TEST_CASE("a ray within rounding of a silhouette may be judged either way") {
    // One cube with the field x^2 + y^2 + z^2, on rays along x at the height of the silhouette of radius 0.5 and a little
    // beside.
    const Model model(bent_cube(
        Shape::hexahedron, 1, 2, [](const Vector& x) { return x; }, [](const Vector& x) { return x.squaredNorm(); }));
    IsosurfaceTracer tracer(model, {scalar_of_field(model.volume, 0), {0.25}});
    IsosurfaceJudge single(tracer, float32_tolerance), twice(tracer, float64_tolerance);
    const auto line = [](double height) { return Line{{-3, 0, height}, {1, 0, 0}}; };
    const double nothing = std::nan("");
    for (const double off : {1e-6, -1e-6}) {
        CHECK(single.accepts(line(0.5 + off), nothing));
        CHECK(single.accepts(line(0.5 + off), 3));
        CHECK(twice.accepts(line(0.5 + off), nothing) == (off > 0));
        CHECK_FALSE(twice.accepts(line(0.5 + off), 3));
        CHECK(tracer.first(line(0.5 + off)).crossing.has_value() == (off < 0));
    }
    CHECK(tracer.first(line(0.51)).margin == Approx(0.0101 / tracer.range()));
    for (const double off : {1e-3, -1e-3})
        for (IsosurfaceJudge* judge : {&single, &twice}) {
            CHECK(judge->accepts(line(0.5 + off), nothing) == (off > 0));
            CHECK_FALSE(judge->accepts(line(0.5 + off), 3));
        }
    // In front of the far side there is the near one.
    CHECK(twice.accepts(line(0.3), 3 - 0.4));
    CHECK_FALSE(twice.accepts(line(0.3), 3 + 0.4));
    // Two roots a millionth apart, at no sample's place: found by the closer look at extremes alone.
    const double height = 0.5 - 1e-12;
    const Vector direction = Vector(3, 0, -1).normalized();
    const Line tangent{height * Vector(1, 2, 3).normalized() - 2 * direction, direction};
    for (const RootFinder finder : {RootFinder::series, RootFinder::samples, RootFinder::companion}) {
        const std::optional<Crossing> crossing = tracer.first(tangent, finder).crossing;
        REQUIRE(crossing);
        CHECK(crossing->t == Approx(2 - std::sqrt(0.25 - height * height)).margin(1e-9));
    }
}

TEST_CASE("each element of a discontinuous field is looked at by itself") {
    // Two cubes along x with f = x - 0.2 and f = x + 0.2: no value -0.1 in the first, whose values end at -0.2 where it leaves.
    VolumeData data;
    const std::vector<Map> maps = boxes({-1, -1, -1}, {1, 1, 1}, {2, 1, 1});
    for (std::size_t i = 0; i < 2; ++i)
        data.classes.push_back(make_class(
            space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 2), {maps[i]},
            [i](const Vector& x) { return x.x() + (i == 0 ? -0.2 : 0.2); }, static_cast<std::int64_t>(7 - i)));
    const Model model(data);
    const Line line{{-3, 0.1, 0.2}, {1, 0, 0}};
    const auto first = [&](const std::vector<double>& values, const std::vector<std::array<double, 4>>& clip = {}) {
        return IsosurfaceTracer(model, {scalar_of_field(model.volume, 0), values, clip}).first(line).crossing;
    };
    CHECK_FALSE(first({-0.1}));
    CHECK(first({-0.5})->t == Approx(2.7));
    CHECK(first({0.5})->t == Approx(3.3));
    CHECK(first({-0.5, 0.5})->value == 0);
    CHECK(first({-0.5})->element == 0);
    // Without x < 0 the first crossing is the other one.
    CHECK(first({-0.5, 0.5}, {{1, 0, 0, 0}})->value == 1);
    CHECK_FALSE(first({-0.5}, {{1, 0, 0, 0}}));
    IsosurfaceTracer tracer(model, {scalar_of_field(model.volume, 0), {-0.1}});
    CHECK(IsosurfaceJudge(tracer, float32_tolerance).accepts(line, std::nan("")));
    CHECK_FALSE(IsosurfaceJudge(tracer, float32_tolerance).accepts(line, 3));

    // Where they share a point the lowest number has it: that of the second, whatever their order.
    for (ClassData& c : data.classes)
        c.field_coefficients = Fit(c.field)([](const Vector& xi) { return xi.y(); });
    const Model shared(data);
    const auto crossing =
        IsosurfaceTracer(shared, {scalar_of_field(shared.volume, 0), {0.1}}).first({{0, -3, 0.2}, {0, 1, 0}}).crossing;
    REQUIRE(crossing);
    CHECK(shared.volume.number(crossing->element) == 6);
}

} // namespace elvis::oracle
