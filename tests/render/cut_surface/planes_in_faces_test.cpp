// Planes that lie exactly in faces of elements, where rounding decides.
#include <core/oracle/picture/view.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr std::array<Shape, 4> shapes = {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron};
constexpr std::uint32_t picture_size = 40;

/** Of 2^3 cells: moves points within the planes 0, 1/2 and 1 of each coordinate, by a cubic map of the coordinate across. */
Vector bent_in_planes(const Vector& x) {
    Vector bent;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const double across = x[(i + 1) % 3] - 0.5;
        bent[i] = x[i] + 1.2 * x[i] * (1 - x[i]) * (x[i] - 0.5) * (1 + 0.5 * across);
    }
    return bent;
}

/** Fits leave the rounding that converted files have. */
VolumeData cells(Shape shape, std::uint32_t geometry_order, double shift, const Function& function) {
    const auto world = [=](const Vector& x) -> Vector {
        return (geometry_order == 1 ? x : bent_in_planes(x)) + shift * Vector(1, -0.7, 0.4);
    };
    VolumeData data;
    // The field's space holds what is linear in the world.
    data.classes.push_back(
        make_class(space_of(shape, geometry_order), space_of(shape, geometry_order), compose(cube(shape, 2), world), function));
    return data;
}

} // namespace

TEST_CASE("a plane in an outer face has no holes") {
    for (const Shape shape : shapes) {
        for (const auto& [geometry_order, shift] : {std::pair{1u, 0.0}, {4u, 0.0}, {4u, 1e4}}) {
            VolumeData data = cells(shape, geometry_order, shift, [](const Vector&) { return 1; });
            const TemporaryFile file("outer.h5");
            write_volume(file.path(), data);
            const RuntimeVolume volume = open_volume(file.path());
            const Model model(std::move(data));
            for (const double side : {0.0, 1.0}) {
                const CutPlane plane{{1, 0, 0, -shift - side}};
                const FrameRequest request = view_of(model, plane, picture_size, picture_size, 0, 1);
                const Picture exact = draw(model, request);
                for (const Precision precision : {Precision::float32, Precision::float64}) {
                    const Frame frame = Renderer(device(), volume, precision).render(request);
                    std::size_t n_holes = 0;
                    for (std::size_t pixel = 0; pixel < frame.element.size(); ++pixel) {
                        n_holes += exact.is_inside[pixel] != 0 && frame.element[pixel] < 0;
                    }
                    INFO(native::name(shape) << " of order " << geometry_order << " shifted by " << shift);
                    CHECK(n_holes == 0);
                }
            }
        }
    }
}

TEST_CASE("a plane in inner faces is flagged where the elements' values differ, and nowhere else") {
    for (const Shape shape : shapes) {
        for (const double jump : {0.0, 0.1}) {
            VolumeData data = cells(shape, 4, 0, [](const Vector& x) { return x.y() + x.z(); });
            ClassData& elements = data.classes.front();
            const std::vector<double> one = Fit(elements.field)([](const Vector&) { return 1; });
            for (std::size_t i = 0; i < elements.field_coefficients.size(); ++i) {
                elements.field_coefficients[i] += jump * static_cast<double>(i / one.size()) * one[i % one.size()];
            }
            const TemporaryFile file("inner.h5");
            write_volume(file.path(), data);
            const RuntimeVolume volume = open_volume(file.path());
            REQUIRE(volume.fields().front().continuity != ELVIS_CONTINUITY_CONTINUOUS);
            const Model model(std::move(data));
            const FrameRequest request = view_of(model, {{1, 0, 0, -0.5}}, picture_size, picture_size, 0, 4);
            for (const Precision precision : {Precision::float32, Precision::float64}) {
                const Frame frame = Renderer(device(), volume, precision).render(request);
                INFO(native::name(shape) << " with a jump of " << jump);
                CHECK(frame.counts.hit_pixels > 300);
                if (jump > 0) {
                    CHECK(frame.counts.undecided_pixels == frame.counts.hit_pixels);
                } else {
                    CHECK(frame.counts.undecided_pixels <= frame.counts.hit_pixels / 100);
                }
            }
        }
    }
}

TEST_CASE("where a face between elements ends in the boundary it is not decided that a point lies inside") {
    // Pixels' points have coordinates of few digits: a column lies in the face x = 1/2, whose upper end is in the boundary y
    // = 1.
    VolumeData data = cells(Shape::hexahedron, 1, 0, [](const Vector& x) { return x.y(); });
    data.classes.front().field_coefficients.assign(data.classes.front().field_coefficients.size(), 0.25);
    const TemporaryFile file("edge.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = request.height = 33;
    request.camera.orthographic = true;
    request.camera.eye = {0.5, 1, 4};
    request.camera.look_at = {0.5, 1, 0};
    request.camera.up = {0, 1, 0};
    request.camera.height = 33.0 / 64;
    Surface surface;
    surface.geometry = CutPlane{{0, 0, 1, -0.25}};
    surface.colors.points = {{0, {0, 0, 1}}, {1, {1, 0, 0}}};
    request.surfaces = {surface};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        const auto is_undecided = [&](std::size_t column, std::size_t row) {
            return (frame.flags[row * request.width + column] & pixel_flag::undecided) != 0;
        };
        CHECK(is_undecided(16, 16));
        CHECK(is_undecided(20, 16));
        CHECK_FALSE(is_undecided(16, 20));
        CHECK_FALSE(is_undecided(20, 20));
        CHECK(frame.element[20 * request.width + 16] >= 0);
        CHECK(frame.element[12 * request.width + 16] < 0);
    }
}

} // namespace elvis::oracle
