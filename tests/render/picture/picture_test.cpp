// Pictures of the renderer against the oracle's.
#include <core/oracle/picture/compare.hpp>
#include <core/oracle/picture/view.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

using native::Shape;

// Draws a plane in both precisions and checks the promises; `size` pixels wide and high. Flags are for the few pixels that
// rounding decides, whatever they show, unless the plane lies in faces.
void check_plane(const std::string& name, VolumeData data, const CutPlane& plane, std::uint32_t size, double tilt = 17,
                 double flagged_share = 0.001) {
    const TemporaryFile file("picture.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    FrameRequest request = view_of(model, plane, size, size, 0, 1, tilt);
    const auto [low, high] = value_range(draw(model, request));
    request.surfaces[0].colors = view_of(model, plane, 1, 1, low, high).surfaces[0].colors;
    const Picture exact = draw(model, request);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        const Comparison comparison = compare(model, exact, frame);
        const bool is_single = precision == Precision::float32;
        WARN(name << (is_single ? ", float32: " : ", float64: ") << to_text(comparison));
        CHECK(comparison.both_inside > comparison.pixels / 20);
        CHECK(comparison.max_channel_error <= (is_single ? 1e-3 : 1e-9));
        CHECK(comparison.disagreement_share() <= 1e-4);
        CHECK(comparison.max_edge_distance <= 1e-5);
        CHECK(static_cast<double>(comparison.flagged_alternatives + comparison.needless_flags) <=
              flagged_share * static_cast<double>(comparison.both_inside));
        CHECK(comparison.newton_failures == 0);
        CHECK(frame.counts.newton_failures == 0);
        CHECK(exact.counts.unresolved == 0);
    }
}

// Varies over a few elements' length in every direction.
double wavy(const Vector& x) { return std::sin(3 * x.x()) * std::cos(2 * x.y()) + std::sin(2.5 * x.z() + x.x() * x.y()); }

} // namespace

TEST_CASE("a curved mixed volume of order 6 is drawn as the oracle draws it") {
    check_plane("mixed", mixed_volume(3, 6, wavy), {{1, 0.7, 0.5, -1.1}}, 200);
}

TEST_CASE("each shape alone is drawn as the oracle draws it") {
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        VolumeData data;
        data.classes.push_back(
            make_class(space_of(shape, 2), space_of(shape, 3), compose(cube(shape, 2), quadratic_bend), wavy));
        check_plane(std::string(native::name(shape)), std::move(data), {{0.3, 1, -0.4, -0.3}}, 160);
    }
}

TEST_CASE("a plane in faces of a discontinuous field shows the viewer's side") {
    // One value in each element, cube faces in the plane x = 0.5, seen from either side and straight on.
    for (const double side : {-1.0, 1.0})
        for (const double tilt : {0.0, 30.0}) {
            VolumeData data;
            data.classes.push_back(make_class(space_of(Shape::hexahedron, 1),
                                              {Shape::hexahedron, native::Basis::modified, {0, 0, 0}},
                                              cube(Shape::hexahedron, 4), [](const Vector& x) {
                                                  const Vector cell = (4 * x).array().floor();
                                                  return cell.x() + 0.37 * cell.y() + 0.11 * cell.z();
                                              }));
            // The fit leaves rounding, which would move the faces out of the plane.
            for (double& coordinate : data.classes.front().geometry_coefficients)
                coordinate = std::round(4 * coordinate) / 4;
            check_plane("in faces", std::move(data), {{side, 0, 0, -0.5 * side}}, 121, tilt, 1);
        }
}

TEST_CASE("no pixel is lost where Newton's method takes its time on strongly curved elements") {
    // A torus of few elements: predictions from far away lie outside of the element that holds the point, and creep into it.
    const TemporaryFile file("torus.h5");
    generate(R"({"generator": 1, "mesh": "torus", "shape": "mixed", "elements": [3, 3, 16], "layers": 4, "geometry_order": 3,
                 "order": 2, "field": "waves"})",
             file.path());
    for (const CutPlane& plane : {CutPlane{{0.9, -0.45, 0, 0}}, CutPlane{{0, 0, 1, 0.1}}}) {
        check_plane("torus", read_volume(file.path(), 0, 0), plane, 400);
    }
}

TEST_CASE("no pixel is lost where the search runs into the apex of a strongly bent pyramid") {
    // Of higher order than the elements: what the fit makes of it is not smooth at the apex.
    const auto bend = [](const Vector& x) -> Vector {
        Vector bent;
        for (Eigen::Index i = 0; i < 3; ++i)
            bent[i] = x[i] + 1.2 * x[i] * (1 - x[i]) * (x[i] - 0.5) * (1 + 0.5 * (x[(i + 1) % 3] - 0.5));
        return quadratic_bend(bent);
    };
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::pyramid, 6), space_of(Shape::pyramid, 1),
                                      compose(cube(Shape::pyramid, 2), bend), [](const Vector&) { return 1; }));
    const TemporaryFile file("pyramids.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    const FrameRequest request = view_of(model, {{0, 0, 1, -1}}, 50, 50, 0, 2);
    const Picture exact = draw(model, request);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        std::size_t n_lost = 0;
        for (std::size_t pixel = 0; pixel < frame.element.size(); ++pixel)
            n_lost += exact.is_inside[pixel] != 0 && frame.element[pixel] < 0 && frame.flags[pixel] == 0;
        CHECK(n_lost == 0);
    }
}

TEST_CASE("a volume far from the origin with a large offset is drawn exactly") {
    VolumeData data;
    const auto far = [](const Vector& x) -> Vector { return quadratic_bend(x) + Vector(1000, -2000, 500); };
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 2), space_of(Shape::hexahedron, 4),
                                      compose(cube(Shape::hexahedron, 3), far),
                                      [](const Vector& x) { return 101325 + wavy(x - Vector(1000, -2000, 500)); }));
    check_plane("far away", std::move(data), {{1, 0.7, 0.5, -1000 + 1400 - 250 - 1.1}}, 160);
}

TEST_CASE("an element that folds neither hangs nor draws what is not there") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::tetrahedron, 2), space_of(Shape::tetrahedron, 3),
                                      {twisted_tetrahedron({0, 0, 0.6})}, [](const Vector& x) { return x.x() + x.z(); }));
    const TemporaryFile file("twisted.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    // Half a pixel off x = 5/12, where a whole segment of the element maps to one point.
    const CutPlane plane{{0, 1, 0, -0.2}};
    const FrameRequest request = view_of(model, plane, 160, 160, 0, 1.5);
    const Picture exact = draw(model, request);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        const Comparison comparison = compare(model, exact, frame);
        WARN("twisted: " << to_text(comparison));
        // Whatever is drawn without a flag is right: the field is continuous in x here.
        std::size_t n_wrong = 0;
        for (std::size_t pixel = 0; pixel < frame.value.size(); ++pixel)
            n_wrong += frame.flags[pixel] == 0 && frame.element[pixel] >= 0 && exact.is_inside[pixel] != 0 &&
                       std::abs(frame.value[pixel] - exact.value[pixel]) > 1e-3;
        CHECK(n_wrong == 0);
        CHECK(frame.counts.newton_failures == comparison.newton_failures);
    }
}

} // namespace elvis::oracle
