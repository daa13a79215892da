// Reference shapes: corners, faces, coordinates. The numbering is that of elvis/element.h.
#include <elvis/native/space.hpp>

#include <cassert>
#include <cstddef>

namespace elvis::native {
namespace {

struct FaceCorners {
    int count;
    std::array<int, 4> corners;
};

constexpr FaceCorners hexahedron_faces[] = {{4, {0, 1, 2, 3}}, {4, {0, 1, 5, 4}}, {4, {1, 2, 6, 5}},
                                            {4, {3, 2, 6, 7}}, {4, {0, 3, 7, 4}}, {4, {4, 5, 6, 7}}};
constexpr FaceCorners prism_faces[] = {
    {4, {0, 1, 2, 3}}, {3, {0, 1, 4, 0}}, {4, {1, 2, 5, 4}}, {3, {3, 2, 5, 0}}, {4, {0, 3, 5, 4}}};
constexpr FaceCorners pyramid_faces[] = {
    {4, {0, 1, 2, 3}}, {3, {0, 1, 4, 0}}, {3, {1, 2, 4, 0}}, {3, {3, 2, 4, 0}}, {3, {0, 3, 4, 0}}};
constexpr FaceCorners tetrahedron_faces[] = {{3, {0, 1, 2, 0}}, {3, {0, 1, 3, 0}}, {3, {1, 2, 3, 0}}, {3, {0, 2, 3, 0}}};
constexpr FaceCorners quadrilateral_faces[] = {{2, {0, 1, 0, 0}}, {2, {1, 2, 0, 0}}, {2, {3, 2, 0, 0}}, {2, {0, 3, 0, 0}}};
constexpr FaceCorners triangle_faces[] = {{2, {0, 1, 0, 0}}, {2, {1, 2, 0, 0}}, {2, {0, 2, 0, 0}}};

std::span<const FaceCorners> faces(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return hexahedron_faces;
    case Shape::prism:
        return prism_faces;
    case Shape::pyramid:
        return pyramid_faces;
    case Shape::tetrahedron:
        return tetrahedron_faces;
    case Shape::quadrilateral:
        return quadrilateral_faces;
    case Shape::triangle:
        return triangle_faces;
    }
    return {};
}

constexpr Point cube_corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
constexpr Point prism_corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {-1, 1, 1}};
constexpr Point pyramid_corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}};
constexpr Point tetrahedron_corners[] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
constexpr Point quadrilateral_corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
constexpr Point triangle_corners[] = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};

std::span<const Point> corners(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return cube_corners;
    case Shape::prism:
        return prism_corners;
    case Shape::pyramid:
        return pyramid_corners;
    case Shape::tetrahedron:
        return tetrahedron_corners;
    case Shape::quadrilateral:
        return quadrilateral_corners;
    case Shape::triangle:
        return triangle_corners;
    }
    return {};
}

// 2 (1 + x) / scale - 1, and -1 at the singular point.
double collapsed(double x, double scale) { return scale == 0 ? -1.0 : 2 * (1 + x) / scale - 1; }

} // namespace

int dimension(Shape shape) { return shape == Shape::quadrilateral || shape == Shape::triangle ? 2 : 3; }

int n_corners(Shape shape) { return static_cast<int>(corners(shape).size()); }

int n_faces(Shape shape) { return static_cast<int>(faces(shape).size()); }

std::span<const int> face_corners(Shape shape, int local_face) {
    assert(local_face >= 0 && local_face < n_faces(shape));
    const FaceCorners& face = faces(shape)[static_cast<std::size_t>(local_face)];
    return {face.corners.data(), static_cast<std::size_t>(face.count)};
}

Point corner(Shape shape, int index) {
    assert(index >= 0 && index < n_corners(shape));
    return corners(shape)[static_cast<std::size_t>(index)];
}

std::string_view name(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return "hexahedron";
    case Shape::prism:
        return "prism";
    case Shape::pyramid:
        return "pyramid";
    case Shape::tetrahedron:
        return "tetrahedron";
    case Shape::quadrilateral:
        return "quadrilateral";
    case Shape::triangle:
        return "triangle";
    }
    return "unknown";
}

std::string_view name(Basis basis) {
    switch (basis) {
    case Basis::modified:
        return "modified";
    case Basis::orthogonal:
        return "orthogonal";
    case Basis::gll_lagrange:
        return "gll_lagrange";
    case Basis::gauss_lagrange:
        return "gauss_lagrange";
    case Basis::tensor:
        return "tensor";
    }
    return "unknown";
}

Point collapse(Shape shape, const Point& xi) {
    switch (shape) {
    case Shape::prism:
        return {collapsed(xi[0], 1 - xi[2]), xi[1], xi[2]};
    case Shape::pyramid:
        return {collapsed(xi[0], 1 - xi[2]), collapsed(xi[1], 1 - xi[2]), xi[2]};
    case Shape::tetrahedron:
        return {collapsed(xi[0], -xi[1] - xi[2]), collapsed(xi[1], 1 - xi[2]), xi[2]};
    case Shape::triangle:
        return {collapsed(xi[0], 1 - xi[1]), xi[1], 0};
    case Shape::hexahedron:
    case Shape::quadrilateral:
        break;
    }
    return xi;
}

Point expand(Shape shape, const Point& eta) {
    const auto expanded = [](double value, double scale) { return (1 + value) * scale / 2 - 1; };
    switch (shape) {
    case Shape::prism:
        return {expanded(eta[0], 1 - eta[2]), eta[1], eta[2]};
    case Shape::pyramid:
        return {expanded(eta[0], 1 - eta[2]), expanded(eta[1], 1 - eta[2]), eta[2]};
    case Shape::tetrahedron: {
        const double xi2 = expanded(eta[1], 1 - eta[2]);
        return {expanded(eta[0], -xi2 - eta[2]), xi2, eta[2]};
    }
    case Shape::triangle:
        return {expanded(eta[0], 1 - eta[1]), eta[1], 0};
    case Shape::hexahedron:
    case Shape::quadrilateral:
        break;
    }
    return eta;
}

bool is_inside(Shape shape, const Point& xi, double tolerance) {
    const auto above = [&](double value) { return value >= -1 - tolerance; };
    const auto within = [&](double value) { return value >= -1 - tolerance && value <= 1 + tolerance; };
    switch (shape) {
    case Shape::hexahedron:
        return within(xi[0]) && within(xi[1]) && within(xi[2]);
    case Shape::prism:
        return above(xi[0]) && within(xi[1]) && above(xi[2]) && xi[0] + xi[2] <= tolerance;
    case Shape::pyramid:
        return above(xi[0]) && above(xi[1]) && above(xi[2]) && xi[0] + xi[2] <= tolerance && xi[1] + xi[2] <= tolerance;
    case Shape::tetrahedron:
        return above(xi[0]) && above(xi[1]) && above(xi[2]) && xi[0] + xi[1] + xi[2] <= -1 + tolerance;
    case Shape::quadrilateral:
        return within(xi[0]) && within(xi[1]);
    case Shape::triangle:
        return above(xi[0]) && above(xi[1]) && xi[0] + xi[1] <= tolerance;
    }
    return false;
}

} // namespace elvis::native
