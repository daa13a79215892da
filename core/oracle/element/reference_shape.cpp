#include "reference_shape.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace elvis::oracle {

using native::Shape;

std::span<const FaceConstraint> face_constraints(Shape shape) {
    static const FaceConstraint hexahedron[] = {{{-1, 0, 0}, 1}, {{1, 0, 0}, 1},  {{0, -1, 0}, 1},
                                                {{0, 1, 0}, 1},  {{0, 0, -1}, 1}, {{0, 0, 1}, 1}};
    static const FaceConstraint prism[] = {{{-1, 0, 0}, 1}, {{0, -1, 0}, 1}, {{0, 1, 0}, 1}, {{0, 0, -1}, 1}, {{1, 0, 1}, 0}};
    static const FaceConstraint pyramid[] = {{{-1, 0, 0}, 1}, {{0, -1, 0}, 1}, {{0, 0, -1}, 1}, {{1, 0, 1}, 0}, {{0, 1, 1}, 0}};
    static const FaceConstraint tetrahedron[] = {{{-1, 0, 0}, 1}, {{0, -1, 0}, 1}, {{0, 0, -1}, 1}, {{1, 1, 1}, -1}};
    switch (shape) {
    case Shape::hexahedron:
        return hexahedron;
    case Shape::prism:
        return prism;
    case Shape::pyramid:
        return pyramid;
    case Shape::tetrahedron:
        return tetrahedron;
    default:
        throw std::invalid_argument("the oracle knows three-dimensional shapes only");
    }
}

std::size_t constraint_of_local_face(Shape shape, std::size_t local_face) {
    static const std::vector<std::size_t> hexahedron{4, 2, 1, 3, 0, 5}, prism{3, 1, 4, 2, 0}, pyramid{2, 1, 3, 4, 0},
        tetrahedron{2, 1, 3, 0};
    switch (shape) {
    case Shape::hexahedron:
        return hexahedron.at(local_face);
    case Shape::prism:
        return prism.at(local_face);
    case Shape::pyramid:
        return pyramid.at(local_face);
    default:
        return tetrahedron.at(local_face);
    }
}

double excess(Shape shape, const Vector& xi) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const FaceConstraint& face : face_constraints(shape))
        largest = std::max(largest, face.normal.dot(xi) - face.offset);
    return largest;
}

Vector centre(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return {0, 0, 0};
    case Shape::prism:
        return {-1.0 / 3, 0, -1.0 / 3};
    case Shape::pyramid:
        return {-0.25, -0.25, -0.5};
    default:
        return {-0.5, -0.5, -0.5};
    }
}

} // namespace elvis::oracle
