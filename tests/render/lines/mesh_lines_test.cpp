// Mesh lines against exact tests of each pixel's square.
#include "lines.hpp"
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr double mild = 0.2;

// Range of x - bend y^2 over the quadrilateral: its extremes lie on the sides, where it is quadratic.
std::array<long double, 2> bent_range(const Square& square, long double bend = mild) {
    const auto g = [bend](long double x, long double y) { return x - bend * y * y; };
    long double least = std::numeric_limits<long double>::infinity(), most = -least;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point& a = square[i];
        const Point& b = square[(i + 1) % 4];
        const long double dx = b[0] - a[0], dy = b[1] - a[1];
        // d/ds (dx s - bend (a1 + dy s)^2) = 0
        const long double s = dy != 0 ? std::clamp((dx / (2 * bend * dy) - a[1]) / dy, 0.0L, 1.0L) : 0.0L;
        for (const long double place : {0.0L, s, 1.0L}) {
            const long double value = g(a[0] + place * dx, a[1] + place * dy);
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    return {least, most};
}

bool has_quarter(long double least, long double most) { return std::ceil(4 * least) <= 4 * most; }

} // namespace

TEST_CASE("mesh lines are right to the pixel, on straight and curved elements, or marked undecided") {
    for (const bool is_curved : {false, true}) {
        const auto bent = [is_curved](const Vector& x) -> Vector {
            return {x.x() + (is_curved ? mild * x.y() * x.y() : 0), x.y(), x.z()};
        };
        const TemporaryFile file("lines.h5");
        VolumeData data;
        data.classes.push_back(make_class(space_of(Shape::hexahedron, is_curved ? 2 : 1), space_of(Shape::hexahedron, 1),
                                          compose(cube(Shape::hexahedron, 4), bent), [](const Vector& x) { return x.x(); }));
        write_volume(file.path(), data);
        const RuntimeVolume volume = open_volume(file.path());
        for (const Precision precision : {Precision::float64, Precision::float32}) {
            Renderer renderer(device(), volume, precision);
            for (const double magnification : {2.0, 50.0, 1000.0}) {
                // A crossing of lines.
                const Point middle = {0.5L + (is_curved ? mild * 0.25L : 0.0L), 0.5L};
                FrameRequest request = view_around(middle, magnification, 160);
                request.camera.image_shift = {0.31, 0.17};
                request.surfaces[0].mesh_lines.emplace();
                const Frame frame = renderer.render(request);
                const Verdict verdict =
                    judge(request, frame, pixel_flag::mesh_line, pixel_flag::mesh_line_undecided, [&](const Square& square) {
                        const auto [low, high] = std::minmax({square[0][1], square[1][1], square[2][1], square[3][1]});
                        const auto [left, right] = std::minmax({square[0][0], square[1][0], square[2][0], square[3][0]});
                        const auto [least, most] = is_curved ? bent_range(square) : std::array<long double, 2>{left, right};
                        return has_quarter(low, high) || has_quarter(least, most);
                    });
                const bool is_double = precision == Precision::float64;
                WARN((is_curved ? "curved" : "straight")
                     << (is_double ? ", float64" : ", float32") << ", magnified " << magnification << ": " << verdict.marked
                     << " pixels, " << verdict.undecided << " undecided, " << verdict.wrong << " wrong");
                CHECK(verdict.wrong == 0);
                CHECK(verdict.marked + verdict.undecided >= 300);
                if (is_double) {
                    CHECK(verdict.undecided <= 2);
                }
            }
        }
    }
}

TEST_CASE("mesh lines of strongly curved elements are right in pixels that are large beside them") {
    constexpr double strong = 0.9;
    const auto bent = [](const Vector& x) -> Vector { return {x.x() + strong * x.y() * x.y(), x.y(), x.z()}; };
    const TemporaryFile file("strong.h5");
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 2), space_of(Shape::hexahedron, 1),
                                      compose(cube(Shape::hexahedron, 2), bent), [](const Vector& x) { return x.x(); }));
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float64);
    std::size_t marked = 0, wrong = 0, undecided = 0;
    for (int shift = 0; shift < 60; ++shift) {
        FrameRequest request = view_around({0.5L + strong * 0.25L, 0.5L}, 3, 10);
        request.camera.image_shift = {0.618 * shift - std::floor(0.618 * shift), 0.414 * shift - std::floor(0.414 * shift)};
        request.surfaces[0].mesh_lines.emplace();
        request.surfaces[0].subdivisions = static_cast<std::uint32_t>(shift % 3) * 3;
        const Verdict verdict =
            judge(request, renderer.render(request), pixel_flag::mesh_line, pixel_flag::mesh_line_undecided,
                  [&](const Square& square) {
                      const auto [low, high] = std::minmax({square[0][1], square[1][1], square[2][1], square[3][1]});
                      const auto [least, most] = bent_range(square, strong);
                      return (low <= 0.5L && high >= 0.5L) || (least <= 0.5L && most >= 0.5L);
                  });
        marked += verdict.marked;
        wrong += verdict.wrong;
        undecided += verdict.undecided;
    }
    WARN(marked << " pixels, " << undecided << " undecided, " << wrong << " wrong");
    CHECK(marked > 500);
    CHECK(wrong == 0);
}

TEST_CASE("a plane in faces shows their edges as mesh lines, and nothing else") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1),
                                      cube(Shape::hexahedron, 4), [](const Vector& x) { return x.x(); }));
    const TemporaryFile file("faces.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float64);
    FrameRequest request;
    request.width = request.height = 100;
    request.camera.orthographic = true;
    request.camera.height = 1.2;
    request.camera.eye = {0.503, 0.5027, 3};
    request.camera.look_at = {0.503, 0.5027, 0};
    request.camera.up = {0, 1, 0};
    Surface surface;
    surface.geometry = CutPlane{{0, 0, 1, -0.5}};
    surface.colors.points = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    const Frame frame = renderer.render(request);
    // Pixels are 0.012 wide; a line is one pixel wide, or two where it ends.
    const auto meets = [](double low, double high) { return std::ceil(4 * std::max(low, 0.0)) <= 4 * std::min(high, 1.0); };
    std::size_t wrong = 0, marked = 0;
    for (std::uint32_t row = 0; row < 100; ++row) {
        for (std::uint32_t column = 0; column < 100; ++column) {
            const double left = 0.503 - 0.6 + 0.012 * column, bottom = 0.5027 + 0.6 - 0.012 * (row + 1);
            const double right = left + 0.012, top = bottom + 0.012;
            const bool touches = right >= 0 && left <= 1 && top >= 0 && bottom <= 1;
            const bool is_line = touches && (meets(left, right) || meets(bottom, top));
            const bool is_marked = (frame.flags[row * 100 + column] & pixel_flag::mesh_line) != 0;
            marked += is_marked ? 1 : 0;
            wrong += is_line != is_marked ? 1 : 0;
        }
    }
    CHECK(marked > 700);
    CHECK(wrong == 0);
    CHECK(frame.counts.undecided_mesh_line_pixels == 0);
}

TEST_CASE("elements that touch a plane along an edge only are not asked for its lines") {
    // Of the tetrahedra around an edge in the plane some have no face in it.
    const auto stretched = [](const Vector& x) -> Vector { return {x.x(), x.y(), x.z() * plane_z / 0.5}; };
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::tetrahedron, 1), space_of(Shape::tetrahedron, 2),
                                      compose(cube(Shape::tetrahedron, 4), stretched),
                                      [](const Vector& x) { return x.x() * x.x() + x.y() * x.y(); }));
    const TemporaryFile file("edges.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        Renderer renderer(device(), volume, precision);
        for (const double magnification : {0.8, 100.0, 1e4}) {
            FrameRequest request = view_around({0.5L, 0.5L}, magnification, 100);
            request.camera.image_shift = {0.31, 0.17};
            request.surfaces[0].mesh_lines.emplace();
            request.surfaces[0].contours = Contours{{0.2, 0.5, 0.7}, {}};
            const Frame frame = renderer.render(request);
            // Lines of the cubes; those of tetrahedra are more.
            std::size_t missed = 0;
            for (std::uint32_t row = 0; row < frame.height; ++row) {
                for (std::uint32_t column = 0; column < frame.width; ++column) {
                    const Square square = square_of(request, column, row);
                    const auto [low, high] = std::minmax({square[0][1], square[1][1], square[2][1], square[3][1]});
                    const auto [left, right] = std::minmax({square[0][0], square[1][0], square[2][0], square[3][0]});
                    const bool is_in = left >= 0 && right <= 1 && low >= 0 && high <= 1;
                    const bool is_told = (frame.flags[std::size_t{row} * frame.width + column] &
                                          (pixel_flag::mesh_line | pixel_flag::mesh_line_undecided)) != 0;
                    missed += is_in && !is_told && (has_quarter(low, high) || has_quarter(left, right)) ? 1 : 0;
                }
            }
            const FrameCounts& counts = frame.counts;
            WARN("magnified " << magnification << ": " << counts.field_evaluations << " evaluations for "
                              << counts.refined_pixels << " pixels; contours " << counts.contour_pixels << ", "
                              << counts.undecided_contour_pixels << " undecided; mesh lines " << counts.mesh_line_pixels << ", "
                              << counts.undecided_mesh_line_pixels << " undecided, " << missed << " missed");
            CHECK(missed == 0);
            CHECK(counts.mesh_line_pixels + counts.undecided_mesh_line_pixels >= 200);
            if (magnification < 1) {
                CHECK(counts.contour_pixels > 50);
                CHECK(counts.undecided_contour_pixels <= 1);
                CHECK(counts.field_evaluations < 12 * counts.refined_pixels);
            }
        }
    }
}

TEST_CASE("the border of the volume along pixels' borders is told, or undecided, on both sides") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1),
                                      cube(Shape::hexahedron, 2), [](const Vector& x) { return x.x(); }));
    const TemporaryFile file("border.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    // Pixels are 1/32 wide, and x = 1 is between the columns 47 and 48.
    constexpr std::uint32_t size = 64, last_in = 47;
    FrameRequest request;
    request.width = request.height = size;
    request.camera.orthographic = true;
    request.camera.height = 2;
    request.camera.eye = {0.5, 0.5, 3};
    request.camera.look_at = {0.5, 0.5, 0};
    request.camera.up = {0, 1, 0};
    Surface surface;
    surface.geometry = CutPlane{{0, 0, 1, -plane_z}};
    surface.colors.points = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        for (const std::uint32_t column : {last_in, last_in + 1}) {
            for (std::uint32_t row = 20; row < 44; ++row) {
                CHECK((frame.flags[std::size_t{row} * size + column] &
                       (pixel_flag::mesh_line | pixel_flag::mesh_line_undecided)) != 0);
            }
        }
    }
}

} // namespace elvis::oracle
