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
VolumeData cells(Shape shape, std::uint32_t geometry_order, double shift) {
    const auto world = [=](const Vector& x) -> Vector {
        return (geometry_order == 1 ? x : bent_in_planes(x)) + shift * Vector(1, -0.7, 0.4);
    };
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, geometry_order), space_of(shape, 1), compose(cube(shape, 2), world),
                                      [](const Vector&) { return 1; }));
    return data;
}

} // namespace

TEST_CASE("a plane in an outer face has no holes") {
    for (const Shape shape : shapes) {
        for (const auto& [geometry_order, shift] : {std::pair{1u, 0.0}, {4u, 0.0}, {4u, 1e4}}) {
            VolumeData data = cells(shape, geometry_order, shift);
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

} // namespace elvis::oracle
