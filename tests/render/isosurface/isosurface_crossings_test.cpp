// Crossings of a ray that lie close together: beside a face of an element, and behind a transparent isosurface.
#include <core/oracle/picture/ray.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

namespace elvis::oracle {
namespace {

constexpr std::uint32_t size = 40;
constexpr std::uint32_t doubtful = pixel_flag::isosurface_undecided | pixel_flag::undecided;

/** Two cubes of order 1 that share the face x = 0; the field is `behind` for x < 0, in element 0, and `before` for x > 0, in 1.
 */
VolumeData two_cubes(const Function& behind, const Function& before) {
    const native::Space space = space_of(native::Shape::hexahedron, 1);
    VolumeData data;
    data.classes.push_back(make_class(space, space, boxes({-1, -1, -1}, {1, 1, 1}, {2, 1, 1}),
                                      [&](const Vector& x) { return x.x() < 0 ? behind(x) : before(x); }));
    // Each cube has its own polynomial in its closure: values on the face are those of one side alone.
    const std::size_t n_modes = data.classes[0].field_coefficients.size() / 2;
    const Fit fit(space);
    for (const auto& [element, function, shift] : {std::tuple(0u, behind, -0.5), std::tuple(1u, before, 0.5)}) {
        const std::vector<double> coefficients = fit([&](const Vector& xi) {
            return function({0.5 * xi.x() + shift, xi.y(), xi.z()});
        });
        std::ranges::copy(coefficients,
                          data.classes[0].field_coefficients.begin() + static_cast<std::ptrdiff_t>(element * n_modes));
    }
    return data;
}

/** A view from x = 3 of a square of this half side around the origin, and the isosurface of zero. */
FrameRequest request_of(double half_side, double opacity) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera.eye = {3, 0, 0};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 2 * std::atan(half_side / 3) * 180 / 3.141592653589793;
    request.background = {0, 0, 0, 1};
    Surface surface;
    surface.geometry = Isosurfaces{{}, {0}};
    surface.colors.points = {{0, {1, 1, 1}}};
    surface.colors.below = surface.colors.above = {1, 1, 1, 1};
    surface.opacity = opacity;
    request.surfaces = {surface};
    return request;
}

std::uint32_t column_of(std::size_t pixel) { return static_cast<std::uint32_t>(pixel % size); }
std::uint32_t row_of(std::size_t pixel) { return static_cast<std::uint32_t>(pixel / size); }

} // namespace

TEST_CASE("of two crossings beside a face the first one counts") {
    // A ridge along the face, sharp enough that a ray goes in and out of the surface within rounding's bounds.
    const VolumeData data =
        two_cubes([](const Vector& x) { return x.x() + 0.5 * x.y(); }, [](const Vector& x) { return -x.x() + 0.5 * x.y(); });
    const TemporaryFile file("ridge.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    for (const auto& [precision, half_side] : {std::pair(Precision::float32, 2e-5), std::pair(Precision::float64, 2e-14)}) {
        Renderer renderer(device(), volume, precision);
        for (const bool skips : {true, false}) {
            FrameRequest request = request_of(half_side, 1);
            std::get<Isosurfaces>(request.surfaces[0].geometry).skips_by_range = skips;
            const Frame frame = renderer.render(request);
            std::size_t n_judged = 0, n_wrong = 0;
            for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
                const Ray ray = pixel_ray(request.camera, size, size, column_of(pixel), row_of(pixel));
                if (ray.direction.y() <= 0 || (frame.flags[pixel] & doubtful) != 0)
                    continue;
                ++n_judged;
                n_wrong += frame.element[pixel] != 1 || !(std::abs(frame.normal[3 * pixel + 1] + std::sqrt(0.2)) < 1e-5);
            }
            CAPTURE(static_cast<int>(precision), skips, n_judged);
            CHECK(n_judged > size * size / 4);
            CHECK(n_wrong == 0);
        }
    }
}

TEST_CASE("a crossing that rounding may have put beyond a face is doubtful behind a transparent one, too") {
    // Behind the face the field begins just below the isovalue.
    const VolumeData data = two_cubes([](const Vector& x) { return x.x() - 1e-2 * std::abs(1.5 + x.y()) * 1e-4; },
                                      [](const Vector& x) { return 0.1 - 0.2 * x.x(); });
    const TemporaryFile file("jump.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float32);
    const Frame frame = renderer.render(request_of(0.9, 0.5));
    std::size_t n_sure = 0, n_wrong = 0;
    for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
        if ((frame.flags[pixel] & doubtful) != 0)
            continue;
        ++n_sure;
        n_wrong += std::abs(frame.color[4 * pixel] - 0.5) > 1e-3;
    }
    CHECK(n_sure > size * size / 2);
    CHECK(n_wrong == 0);
}

TEST_CASE("a crossing in a face is one layer of a transparent isosurface") {
    // The field rises all the way, slowly in front of the face and fast behind it: rounding leads the first element's crossing
    // far, the second one's not. Both have one where the isosurface meets the face.
    const VolumeData data =
        two_cubes([](const Vector& x) { return 1e-3 * x.x() + x.z(); }, [](const Vector& x) { return x.x() + x.z(); });
    const TemporaryFile file("kink.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    for (const auto& [precision, half_side] : {std::pair(Precision::float32, 1e-6), std::pair(Precision::float64, 2e-15)}) {
        FrameRequest request = request_of(half_side, 0.5);
        request.camera.eye = {-3, 0, 0};
        const Frame frame = Renderer(device(), volume, precision).render(request);
        std::size_t n_twice = 0;
        for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
            n_twice += frame.color[4 * pixel] > 0.6;
        }
        CAPTURE(static_cast<int>(precision));
        CHECK(n_twice == 0);
    }
}

TEST_CASE("a crossing in a face between classes is doubtful where the elements' normals differ") {
    // The isosurface bends by 27 degrees where it meets the face: which side a ray meets is rounding's to say.
    const auto behind = [](const Vector& x) { return x.x() + x.y(); };
    const auto before = [](const Vector& x) { return 3 * x.x() + x.y(); };
    const native::Space geometry = space_of(native::Shape::hexahedron, 1);
    VolumeData data;
    data.classes.push_back(make_class(geometry, geometry, boxes({-1, -1, -1}, {0, 1, 1}, {1, 1, 1}), behind));
    data.classes.push_back(
        make_class(geometry, space_of(native::Shape::hexahedron, 2), boxes({0, -1, -1}, {1, 1, 1}, {1, 1, 1}), before, 1));
    const TemporaryFile file("bend.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    for (const auto& [precision, half_side] : {std::pair(Precision::float32, 4e-6), std::pair(Precision::float64, 4e-15)}) {
        Renderer renderer(device(), volume, precision);
        FrameRequest request = request_of(half_side, 1);
        request.with_buffers = true;
        const Frame frame = renderer.render(request);
        int n_hits = 0, n_wrong = 0, n_doubtful = 0;
        for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
            const Ray ray = pixel_ray(request.camera, size, size, column_of(pixel), row_of(pixel));
            const auto y = ray.origin.y() + 3 * ray.direction.y() / -ray.direction.x();
            const double steep = std::abs(frame.normal[3 * pixel] / frame.normal[3 * pixel + 1]);
            const bool is_hit = !std::isnan(frame.depth[pixel]);
            n_hits += is_hit ? 1 : 0;
            n_doubtful += is_hit && (frame.flags[pixel] & doubtful) != 0 ? 1 : 0;
            n_wrong += is_hit && (frame.flags[pixel] & doubtful) == 0 && std::abs(steep - (y < 0 ? 3 : 1)) > 0.1 ? 1 : 0;
        }
        std::cout << "a bend in a face between classes: " << n_hits << " hits, " << n_doubtful << " doubtful, " << n_wrong
                  << " on the wrong side\n";
        CHECK(n_hits > 500);
        CHECK(n_wrong == 0);
    }
}

TEST_CASE("of several roots in a narrow interval each is found") {
    // Three roots a ray, this far apart, of one polynomial in one element; or of three isovalues of a linear field.
    for (const auto& [precision, gap] : {std::pair(Precision::float32, 0.1), std::pair(Precision::float64, 0.01)})
        for (const bool has_one_value : {true, false}) {
            const auto u = [](const Vector& x) { return x.x() + 0.1 * x.y(); };
            VolumeData data;
            data.classes.push_back(make_class(space_of(native::Shape::hexahedron, 1), space_of(native::Shape::hexahedron, 3),
                                              boxes({-1, -1, -1}, {1, 1, 1}, {1, 1, 1}), [&](const Vector& x) {
                                                  return has_one_value ? (u(x) - gap) * u(x) * (u(x) + gap) : u(x);
                                              }));
            const TemporaryFile file("roots.h5");
            write_volume(file.path(), data);
            const RuntimeVolume volume = open_volume(file.path());
            Renderer renderer(device(), volume, precision);
            FrameRequest request = request_of(0.5, 0.5);
            auto& values = std::get<Isosurfaces>(request.surfaces[0].geometry).values;
            values = has_one_value ? std::vector<double>{0} : std::vector<double>{-gap, 0, gap};
            const Frame frame = renderer.render(request);
            std::size_t n_sure = 0, n_wrong = 0;
            for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
                if ((frame.flags[pixel] & doubtful) != 0)
                    continue;
                ++n_sure;
                n_wrong += std::abs(frame.color[4 * pixel] - 0.875) > 1e-5;
            }
            CAPTURE(static_cast<int>(precision), has_one_value);
            CHECK(n_sure > size * size * 99 / 100);
            CHECK(n_wrong == 0);
        }
}

TEST_CASE("a tile that sees more octants than its list holds misses none") {
    // Ten sheets through 9000 elements: each tile of the small picture sees several hundred of their octants, its list holds
    // 127.
    VolumeData data;
    const native::Space space = space_of(native::Shape::hexahedron, 1);
    data.classes.push_back(make_class(space, space, boxes({-1, -1, -1}, {1, 1, 1}, {10, 30, 30}),
                                      [](const Vector& x) { return x.x() + 0.9 + 0.01 * x.y(); }));
    const TemporaryFile file("many.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        FrameRequest request = request_of(0.7, 0.5);
        auto& values = std::get<Isosurfaces>(request.surfaces[0].geometry).values;
        values.clear();
        for (int i = 0; i < 10; ++i)
            values.push_back(0.1 + 0.17 * i);
        const Frame frame = renderer.render(request);
        std::size_t n_sure = 0, n_wrong = 0;
        for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
            if ((frame.flags[pixel] & doubtful) != 0)
                continue;
            ++n_sure;
            n_wrong += std::abs(frame.color[4 * pixel] - (1 - std::pow(0.5, 10))) > 1e-5;
        }
        CAPTURE(static_cast<int>(precision), n_sure);
        CHECK(n_sure > size * size * 95 / 100);
        CHECK(n_wrong == 0);
        CHECK(frame.counts.work_limit_pixels == 0);
    }
}

} // namespace elvis::oracle
