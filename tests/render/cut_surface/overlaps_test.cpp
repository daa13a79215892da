// Elements that overlap, on cut surfaces.
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/probe/overlaps.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr std::uint32_t picture_size = 64;
constexpr std::uint32_t both_flags = pixel_flag::overlap | pixel_flag::undecided;

double sum(const Vector& x) { return x.x() + 2 * x.y() + 4 * x.z(); }

/** The reference shape with edges of length 1 from `lower` on. */
Map placed(const Vector& lower) {
    return [=](const Vector& xi) -> Vector { return lower + 0.5 * (xi + Vector::Ones()); };
}

/** How far inside the placed shape a point lies; negative outside. */
double depth_in(Shape shape, const Vector& lower, const Vector& x) {
    const Vector from = x - lower;
    const double other_side = shape == Shape::tetrahedron ? 1 - from.sum() : 1 - from.maxCoeff();
    return std::min(from.minCoeff(), other_side);
}

/** Along z, and a little aside. */
Camera from_above() {
    Camera camera;
    camera.orthographic = true;
    camera.eye = {0.7503, 0.6307, 5};
    camera.look_at = {0.7503, 0.6307, 0};
    camera.up = {0, 1, 0};
    camera.height = 2;
    return camera;
}

FrameRequest request_of(const SurfaceGeometry& geometry, bool with_lines) {
    FrameRequest request;
    request.width = request.height = picture_size;
    request.camera = from_above();
    Surface surface;
    surface.geometry = geometry;
    surface.colors.points = {{0, {0, 0, 1}}, {7, {1, 0, 0}}};
    if (with_lines) {
        surface.mesh_lines = MeshLines{};
    }
    request.surfaces = {surface};
    return request;
}

Vector seen_at(const Frame& frame, std::size_t pixel) {
    const auto along = [](std::size_t index) { return 2 * (static_cast<double>(index) + 0.5) / picture_size - 1; };
    const Camera camera = from_above();
    return {camera.eye[0] + along(pixel % picture_size), camera.eye[1] - along(pixel / picture_size),
            camera.eye[2] - frame.depth[pixel]};
}

} // namespace

TEST_CASE("pixels of cut surfaces at which two elements overlap are flagged, and no others") {
    const Vector one(0, 0, 0), other(0.52, 0.27, 0.1);
    const SurfaceGeometry plane = CutPlane{{0.02, 0.01, 1, -0.4}};
    const SurfaceGeometry sphere = CutShape(Sphere{{0.7, 0.6, -0.3}, 0.9});
    // Of one class, of two classes.
    for (const Shape shape : {Shape::hexahedron, Shape::tetrahedron}) {
        VolumeData data;
        if (shape == Shape::hexahedron) {
            data.classes.push_back(make_class(space_of(shape, 1), space_of(shape, 1), {placed(one), placed(other)}, sum));
        } else {
            data.classes.push_back(
                make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1), {placed(one)}, sum));
            data.classes.push_back(make_class(space_of(shape, 1), space_of(shape, 1), {placed(other)}, sum, 1));
        }
        const TemporaryFile file("overlap.h5");
        write_volume(file.path(), data);
        const RuntimeVolume volume = open_volume(file.path());
        CHECK(overlapping_elements(volume) == std::vector<std::uint64_t>{0, 1});
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Renderer renderer(device(), volume, precision);
            for (const auto& [geometry, with_lines] : {std::pair{plane, false}, {plane, true}, {sphere, false}}) {
                const Frame frame = renderer.render(request_of(geometry, with_lines));
                CHECK(frame.counts.overlapping_elements == 2);
                std::size_t n_expected = 0, n_missed = 0, n_false = 0;
                for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
                    const Vector x = seen_at(frame, pixel);
                    const double depth = std::min(depth_in(Shape::hexahedron, one, x), depth_in(shape, other, x));
                    n_expected += depth > 1e-5;
                    n_missed += depth > 1e-5 && (frame.flags[pixel] & both_flags) != both_flags;
                    n_false += !(depth > -1e-5) && (frame.flags[pixel] & pixel_flag::overlap) != 0;
                }
                INFO(native::name(shape) << (with_lines ? ", with lines" : ""));
                CHECK(n_expected > 50);
                CHECK(n_missed == 0);
                CHECK(n_false == 0);
                CHECK(frame.counts.overlap_pixels >= n_expected);
            }
        }
    }
}

TEST_CASE("elements inside a pile of overlapping ones are found, too") {
    // 3^3 boxes, and the same again inside of them.
    std::vector<Map> maps = boxes({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
    const std::vector<Map> more = boxes({0.4, 0.4, 0.4}, {2.6, 2.6, 2.6}, {3, 3, 3});
    maps.insert(maps.end(), more.begin(), more.end());
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1), maps, sum));
    const TemporaryFile file("pile.h5");
    write_volume(file.path(), data);
    CHECK(overlapping_elements(open_volume(file.path())).size() == maps.size());
}

TEST_CASE("elements of a valid bent mesh do not overlap") {
    const TemporaryFile file("mixed.h5");
    write_volume(file.path(), mixed_volume(4, 2, sum));
    const RuntimeVolume volume = open_volume(file.path());
    CHECK(overlapping_elements(volume).empty());
    const Frame frame =
        Renderer(device(), volume, Precision::float32).render(request_of(CutPlane{{0.02, 0.01, 1, -0.4}}, false));
    CHECK(frame.counts.hit_pixels > 500);
    CHECK(frame.counts.overlapping_elements == 0);
    CHECK(frame.counts.overlap_pixels == 0);
}

} // namespace elvis::oracle
