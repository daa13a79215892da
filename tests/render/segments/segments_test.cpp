// Segments of rays against the elements themselves, and where they come from: shells with gaps, overlaps, elements turned
// inside out.
#include <core/accuracy/segment_accuracy.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

double first_coordinate(const Vector& x) { return x.x(); }

void check(const std::string& path, Precision precision, std::size_t n_rays) {
    const SegmentAccuracy r = measure_segments(device(), open_volume(path), Volume(read_volume(path)), precision, n_rays, 4, 7);
    CHECK(r.n_segments > 2 * n_rays);
    CHECK(r.n_missed == 0);
    CHECK(r.n_invented == 0);
    CHECK(r.counts.failures <= r.n_segments / 1000);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_almost_joined == 0);
    // Nothing is excused.
    CHECK(r.counts.undecided == 0);
}

// The segments of rays along x at (y, z), relative to the world's origin.
std::vector<Segment> along_x(const VolumeData& data, double y, double z, SegmentCounts& counts,
                             Precision precision = Precision::float64) {
    const TemporaryFile file("segments.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    DeviceVolume on_device(device(), volume, precision, nullptr);
    on_device.select(0, 0, {0.0});
    SegmentPass pass(device(), volume, on_device);
    const SegmentRay ray = near_centre({-10, y, z}, {0, y, z}, on_device.centre(), precision);
    std::vector<Segment> list = pass.lists(std::span(&ray, 1), counts).front().segments;
    for (Segment& segment : list) {
        segment.enter += ray.origin[0] + on_device.centre()[0];
        segment.leave += ray.origin[0] + on_device.centre()[0];
    }
    return list;
}

VolumeData hexahedra(const std::vector<Map>& maps, std::uint32_t order = 1) {
    VolumeData data;
    data.classes.push_back(
        make_class(space_of(Shape::hexahedron, order), space_of(Shape::hexahedron, 1), maps, first_coordinate));
    return data;
}

Map box(const Vector& lower, const Vector& upper) { return boxes(lower, upper, {1, 1, 1}).front(); }

TEST_CASE("ends of segments lie on the elements' boundaries, and nothing is missed", "[segments]") {
    const auto [mesh, shape] =
        GENERATE(table<std::string, std::string>({{"waves", "hexahedron"},
                                                  {"ball", "hexahedron"},
                                                  {"ball", "tetrahedron"},
                                                  {"torus", "prism"},
                                                  // So curved that a point outside of an element may be taken for the ray's.
                                                  {"torus", "pyramid"},
                                                  {"torus", "tetrahedron"}}));
    const TemporaryFile file("mesh.h5");
    generate(R"({"generator": 1, "mesh": ")" + mesh + R"(", "shape": ")" + shape +
                 R"(", "elements": [4, 4, 12], "geometry_order": 2, "order": 1, "field": "waves"})",
             file.path());
    check(file.path(), GENERATE(Precision::float32, Precision::float64), 60);
}

// Of a torus of tetrahedra, relative to its middle: origin and direction.
SegmentAccuracy of_rays(std::vector<SegmentRay> rays, Precision precision) {
    const TemporaryFile file("torus.h5");
    generate(
        R"({"generator": 1, "mesh": "torus", "shape": "tetrahedron", "elements": [4, 4, 12], "geometry_order": 2, "order": 1,)"
        R"( "field": "waves"})",
        file.path());
    for (SegmentRay& ray : rays) {
        for (std::size_t i = 0; i < 3 && precision == Precision::float32; ++i) {
            ray.origin[i] = static_cast<float>(ray.origin[i]);
            ray.direction[i] = static_cast<float>(ray.direction[i]);
        }
    }
    const RuntimeVolume volume = open_volume(file.path());
    const Volume model(read_volume(file.path()));
    SegmentMeasure measure(device(), volume, model, precision);
    measure.add(rays, 200, 1);
    return measure.result();
}

TEST_CASE("rays go on where an interval that was looked at ends in a strongly bent element", "[segments]") {
    // Where they surely were inside until a tolerance before its end, they were cut off there.
    const SegmentAccuracy r = of_rays({{{1.0446031093597412, 0.1615501195192337, 0.49710619449615479},
                                        {-0.21352298557758331, -0.70390084406865938, 0.67744485826556855}},
                                       {{-0.13972607254981995, -0.56816911697387695, 0.15288639068603516},
                                        {-0.8192058801651001, 0.32804366111308914, 0.47041376263185303}}},
                                      Precision::float32);
    CHECK(r.n_segments > 30);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_missed == 0);
}

TEST_CASE("rays that enter a strongly bent element near a vertex are found", "[segments]") {
    const std::vector<SegmentRay> rays = {{{-0.28444508472905305, 0.66138363348556917, 0.25362569375821753},
                                           {0.83253263146569556, 0.47031130013263089, -0.29273998447830596}},
                                          {{-0.8065111584984197, 1.1143870268090479, 0.11406295397601125},
                                           {-0.45156035295729163, -0.23881293062594555, -0.85968693825306752}},
                                          {{0.29752648995485198, -1.3549739590465233, -0.073151533821220985},
                                           {0.90360185661264014, 0.21831188976417221, -0.36856967253666661}},
                                          {{1.2776550700006992, 0.42780675352683495, 0.085823985116244186},
                                           {-0.32210946927521883, 0.90875501750633481, 0.26534846515534627}}};
    const SegmentAccuracy r = of_rays(rays, GENERATE(Precision::float32, Precision::float64));
    CHECK(r.n_segments > 30);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_missed == 0);
}

TEST_CASE("rays that come in along a bent face are found", "[segments]") {
    // In the middle of an edge; in and out through one face; out of it and in again.
    const std::vector<SegmentRay> rays = {{{0.51498643750800721, -1.2738979136060871, -0.13984065541809945},
                                           {0.29243239293166101, 0.22036872513239222, -0.93054872013655832}},
                                          {{0.99613652618684267, 0.97139729661298335, 0.043295794444468648},
                                           {-0.14265523618451434, 0.10241032312416716, 0.9844600597823886}},
                                          {{-0.93246214227666968, -0.9385231560117091, -0.24663854086225881},
                                           {0.65121499619322842, -0.71433814871382195, 0.25620311868742562}},
                                          {{-0.93355324305239162, 0.089020701192877638, 0.72783970183194391},
                                           {-0.59418111503914428, 0.17942598351704528, -0.78406321108044608}},
                                          {{0.033431343176134838, -0.60272622541654608, -0.055373863235094266},
                                           {-0.99769776243959707, -0.051259793526944132, -0.044402797103294749}},
                                          {{-0.32792862054385885, 0.50174881334342303, -0.0078844395236149188},
                                           {0.81161413582863828, 0.53416465165666349, 0.23653883284494351}}};
    const SegmentAccuracy r = of_rays(rays, GENERATE(Precision::float32, Precision::float64));
    CHECK(r.n_segments > 50);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_missed == 0);
    CHECK(r.counts.undecided == 0);
}

TEST_CASE("rays along bent faces miss nothing without a word", "[segments]") {
    const TemporaryFile file("torus.h5");
    generate(
        R"({"generator": 1, "mesh": "torus", "shape": "tetrahedron", "elements": [4, 4, 12], "geometry_order": 2, "order": 1,)"
        R"( "field": "waves"})",
        file.path());
    const bool is_single = GENERATE(true, false);
    const SegmentAccuracy r = measure_grazing_segments(device(), open_volume(file.path()), Volume(read_volume(file.path())),
                                                       is_single ? Precision::float32 : Precision::float64, 1000, 30, 1);
    CHECK(r.n_missed == 0);
    CHECK(r.n_invented == 0);
    CHECK(r.n_beyond == 0);
    CHECK(r.counts.undecided <= r.n_rays / (is_single ? 20 : 100));
}

TEST_CASE("a ray is found where rounding hides its way into an element", "[segments]") {
    const TemporaryFile file("mixed.h5");
    write_volume(file.path(), mixed_volume(4, 1, first_coordinate));
    const RuntimeVolume volume = open_volume(file.path());
    const Volume model(read_volume(file.path()));
    // Almost along a bent face of two elements that do not know each other: nothing in the second one is surely inside.
    const SegmentRay ray{{-0.10228221118450165, 0.11708156764507294, -0.0086647327989339828},
                         {-0.60709768533706665, -0.48370236468556388, 0.63044780914595433}};
    SegmentMeasure measure(device(), volume, model, Precision::float32);
    measure.add(std::span(&ray, 1), 1000, 1);
    const SegmentAccuracy r = measure.result();
    CHECK(r.n_points > 500);
    CHECK(r.n_missed == 0);
}

TEST_CASE("rays through edges of bent elements have exact ends, or marks", "[segments]") {
    const TemporaryFile file("torus.h5");
    generate(
        R"({"generator": 1, "mesh": "torus", "shape": "tetrahedron", "elements": [4, 4, 12], "geometry_order": 2, "order": 1,)"
        R"( "field": "waves"})",
        file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Volume model(read_volume(file.path()));
    SegmentMeasure measure(device(), volume, model, Precision::float32);
    // The first two had ends without a mark that were off by more than the promise, once.
    std::vector<SegmentRay> rays = {{{-0.26284995675086975, 0.6539534330368042, 0.11668995767831802},
                                     {-0.92920511960983276, -0.36851246426583895, -0.027864635479944864}},
                                    {{-0.11571788787841797, 0.10422974824905396, -0.26346033811569214},
                                     {-0.77167463302612305, -0.62964038806659151, 0.08984007796782531}}};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(0, 1);
    std::normal_distribution<double> normal;
    while (rays.size() < 4000) {
        const std::size_t element = random() % model.n_elements();
        const auto corners = native::face_corners(Shape::tetrahedron, static_cast<int>(random() % 4));
        const native::Point from = native::corner(Shape::tetrahedron, corners[0]),
                            to = native::corner(Shape::tetrahedron, corners[1]);
        const Vector start(from[0], from[1], from[2]), end(to[0], to[1], to[2]);
        const Vector at = model.position(element, start + coordinate(random) * (end - start));
        const Vector eye = at - 10 * Vector(normal(random), normal(random), normal(random)).normalized();
        rays.push_back(
            near_centre({eye.x(), eye.y(), eye.z()}, {at.x(), at.y(), at.z()}, measure.data().centre(), Precision::float32));
    }
    measure.add(rays, 10, 1);
    const SegmentAccuracy r = measure.result();
    CHECK(r.n_segments > 100'000);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_missed == 0);
    CHECK(r.n_invented == 0);
    CHECK(r.counts.undecided <= r.n_rays / 40);
}

TEST_CASE("ends that rounding has blurred are marked as estimates", "[segments]") {
    // Led past an edge: it is moved ahead to find the element around it.
    const SegmentAccuracy r = of_rays({{{-0.45428919792175293, 0.089427724480628967, 0.065455764532089233},
                                        {0.22582274675369263, 0.92621290683746338, 0.3018861711025238}}},
                                      Precision::float32);
    CHECK(r.chord_error > 1e-6);
    CHECK(r.n_beyond == 0);
    CHECK(r.n_missed == 0);
}

TEST_CASE("ends of many segments are exact in single precision, and few are estimates", "[segments]") {
    const TemporaryFile file("torus.h5");
    generate(
        R"({"generator": 1, "mesh": "torus", "shape": "hexahedron", "elements": [4, 4, 12], "geometry_order": 2, "order": 1,)"
        R"( "field": "waves"})",
        file.path());
    const SegmentAccuracy r = measure_segments(device(), open_volume(file.path()), Volume(read_volume(file.path())),
                                               Precision::float32, 10'000, 0, 7);
    CHECK(r.chord_error < 1e-6);
    CHECK(r.n_beyond == 0);
    CHECK(r.counts.estimated < r.n_segments / 1000);
}

TEST_CASE("classes of elements are merged along the ray", "[segments]") {
    const TemporaryFile file("mixed.h5");
    write_volume(file.path(), mixed_volume(3, 1, first_coordinate));
    check(file.path(), GENERATE(Precision::float32, Precision::float64), 200);
}

TEST_CASE("segments of neighbours that do not know each other share their ends", "[segments]") {
    // Enough rays that some are said to be outside of an element too long.
    const TemporaryFile file("mixed.h5");
    write_volume(file.path(), mixed_volume(4, 1, first_coordinate));
    const SegmentAccuracy r = measure_segments(device(), open_volume(file.path()), Volume(read_volume(file.path())),
                                               Precision::float32, 10'000, 0, 1);
    CHECK(r.n_joints > r.n_segments * 4 / 5);
    CHECK(r.n_almost_joined == 0);
    CHECK(r.n_beyond == 0);
}

TEST_CASE("gaps stay, and shared ends are equal", "[segments]") {
    SegmentCounts counts;
    const auto list = along_x(hexahedra({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 0.5, 1}), box({1, 0.5, 0}, {2, 1, 1}),
                                         box({2.000001, 0, 0}, {3, 1, 1})}),
                              0.3, 0.4, counts);
    REQUIRE(list.size() == 3);
    CHECK(list[0].leave == list[1].enter);
    CHECK(list[2].enter - list[1].leave == Approx(1e-6).epsilon(1e-6));
    CHECK(list[0].enter == Approx(0).margin(1e-13));
    CHECK(list[2].leave == Approx(3));
    CHECK(counts.overlaps == 0);
}

TEST_CASE("the element that is entered first owns the ray to its exit", "[segments]") {
    SegmentCounts counts;
    const auto list = along_x(
        hexahedra({box({0.5, 0, 0}, {2, 1, 1}), box({0, 0, 0}, {1, 1, 1}), box({0.2, 0, 0}, {0.7, 1, 1})}), 0.3, 0.4, counts);
    REQUIRE(list.size() == 2);
    CHECK(list[0].element == 1);
    CHECK(list[1].element == 0);
    CHECK(list[0].leave == Approx(1));
    CHECK(list[1].enter == list[0].leave);
    CHECK(list[1].leave == Approx(2));
    CHECK(counts.overlaps == 2);
}

TEST_CASE("rays that start inside have segments from there, and end where they are to", "[segments]") {
    const TemporaryFile file("inside.h5");
    write_volume(file.path(), hexahedra(boxes({0, 0, 0}, {4, 1, 1}, {4, 1, 1})));
    const RuntimeVolume volume = open_volume(file.path());
    DeviceVolume data(device(), volume, Precision::float64, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(device(), volume, data);
    SegmentRay ray = near_centre({1.25, 0.3, 0.4}, {2, 0.3, 0.4}, data.centre(), Precision::float64);
    ray.to = ray.from + 1.5;
    SegmentCounts counts;
    const std::vector<Segment> list = pass.lists(std::span(&ray, 1), counts).front().segments;
    REQUIRE(list.size() == 2);
    CHECK(list[0].element == 1);
    CHECK(list[0].enter == ray.from);
    CHECK(list[0].leave == list[1].enter);
    CHECK(list[1].leave == ray.to);
}

TEST_CASE("the lengths of pixels' segments are the chord", "[segments]") {
    const TemporaryFile file("lengths.h5");
    write_volume(file.path(), hexahedra(boxes({0, 0, 0}, {4, 1, 1}, {4, 1, 1})));
    const RuntimeVolume volume = open_volume(file.path());
    DeviceVolume data(device(), volume, Precision::float64, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(device(), volume, data);
    Camera camera;
    camera.eye = {-10, 0.5, 0.5};
    camera.look_at = {0, 0.5, 0.5};
    camera.up = {0, 0, 1};
    camera.field_of_view = 4;
    CutPlane plane;
    plane.plane = {1, 0, 0, -1};
    const CutPlaneGeometry view = cut_plane_geometry(plane, camera, 9, 9, data.centre());
    SegmentCounts counts;
    const std::vector<double> lengths = pass.lengths(view, {camera.eye, {}}, 9, 9, counts);
    REQUIRE(lengths.size() == 81);
    // Along the axis of view the whole row, for every ray that meets no side.
    CHECK(lengths[40] == Approx(4).epsilon(1e-12));
    CHECK(lengths[41] == Approx(4).epsilon(1e-12));
    CHECK(counts.given_up == 0);
}

TEST_CASE("a ray in a face that elements share has one segment", "[segments]") {
    SegmentCounts counts;
    const auto list = along_x(hexahedra(boxes({0, 0, 0}, {2, 2, 2}, {2, 2, 2})), 1, 0.4, counts);
    REQUIRE(list.size() == 2);
    CHECK(list[0].enter == Approx(0).margin(1e-13));
    CHECK(list[0].leave == list[1].enter);
    CHECK(list[1].leave == Approx(2));
}

TEST_CASE("rays that come in through edges of elements miss nothing", "[segments]") {
    const TemporaryFile file("edges.h5");
    const std::string shape = GENERATE("prism", "tetrahedron");
    // Many elements have an edge in the boundary, but no face.
    generate(R"({"generator": 1, "mesh": "box", "shape": ")" + shape +
                 R"(", "box": [[99, -1, -1], [101, 1, 1]], "elements": [3, 3, 3], "geometry_order": 1, "order": 1,)"
                 R"( "field": "sphere"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    DeviceVolume data(device(), volume, precision, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(device(), volume, data);
    std::vector<SegmentRay> rays;
    std::vector<double> lengths;
    for (int i = 0; i < 4000; ++i) {
        // Of the faces of the box, the lines of the grid and the diagonals of its squares.
        const double along = std::fmod(0.618034 * i, 2.0) - 1, line = (i % 8 < 4 ? -1.0 : 1.0) / 3,
                     across = i % 4 < 2 ? line : along;
        const Vector3 at = {99, i % 4 == 1 ? across : along, i % 4 == 1 ? along : across};
        const Vector3 towards = {1, 0.9 * std::sin(1.7 * i), 0.9 * std::cos(2.3 * i)};
        rays.push_back(near_centre(minus(at, towards), at, data.centre(), precision));
        double distance = 2 / towards[0];
        for (const int axis : {1, 2}) {
            distance = std::min(distance, (std::copysign(1.0, towards[axis]) - at[axis]) / towards[axis]);
        }
        lengths.push_back(distance * elvis::length(towards));
    }
    SegmentCounts counts;
    const std::vector<SegmentList> lists = pass.lists(rays, counts);
    std::size_t n_wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        double sum = 0;
        for (const Segment& segment : lists[i].segments) {
            sum += segment.leave - segment.enter;
        }
        n_wrong += std::abs(sum - lengths[i]) > (precision == Precision::float32 ? 1e-4 : 1e-11) && !lists[i].is_undecided;
    }
    CHECK(n_wrong == 0);
    CHECK(counts.undecided <= rays.size() / 100);
}

TEST_CASE("elements without the wanted values are passed over", "[segments]") {
    const TemporaryFile file("skipped.h5");
    write_volume(file.path(), hexahedra(boxes({0, 0, 0}, {8, 1, 1}, {8, 1, 1})));
    const RuntimeVolume volume = open_volume(file.path());
    DeviceVolume data(device(), volume, Precision::float32, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(device(), volume, data, SegmentPass::SkippedField{});
    const SegmentRay ray = near_centre({-10, 0.3, 0.4}, {0, 0.3, 0.4}, data.centre(), Precision::float32);
    SegmentCounts counts;
    const std::vector<Segment> list = pass.lists(std::span(&ray, 1), counts, {3.2, 4.5}).front().segments;
    REQUIRE(list.size() == 2);
    CHECK(list[0].element == 3);
    CHECK(list[1].element == 4);
    CHECK(list[0].leave == list[1].enter);
    CHECK(counts.evaluations < 10);
}

TEST_CASE("an element is entered and left twice through the same face", "[segments]") {
    // The lower face is an arch, 0.5 high at x = 0: the ray at 0.2 misses what is below it.
    const Map arch = [](const Vector& xi) -> Vector {
        const double floor = 0.5 * (1 - xi.x() * xi.x());
        return {xi.x(), xi.y(), floor + 0.5 * (1 + xi.z()) * (1 - floor)};
    };
    SegmentCounts counts;
    const auto list = along_x(hexahedra({arch}, 2), 0, 0.2, counts);
    const double side = std::sqrt(0.6);
    REQUIRE(list.size() == 2);
    CHECK(list[0].enter == Approx(-1).margin(1e-12));
    CHECK(list[0].leave == Approx(-side).margin(1e-12));
    CHECK(list[1].enter == Approx(side).margin(1e-12));
    CHECK(list[1].leave == Approx(1).margin(1e-12));
}

TEST_CASE("elements turned inside out have segments, and geometry that is no number ends", "[segments]") {
    SegmentCounts counts;
    const Map mirrored = [](const Vector& xi) -> Vector { return {-xi.x(), xi.y(), xi.z()}; };
    const auto list = along_x(hexahedra({mirrored}), 0.3, 0.4, counts);
    REQUIRE(list.size() == 1);
    CHECK(list[0].leave - list[0].enter == Approx(2));
    // Folded: the Jacobian vanishes inside.
    const Map folded = [](const Vector& xi) -> Vector { return {xi.x() * xi.x() + 0.3 * xi.x(), xi.y(), xi.z()}; };
    along_x(hexahedra({folded}, 2), 0.3, 0.4, counts);
    SUCCEED("ended");
}

} // namespace
} // namespace elvis::oracle
