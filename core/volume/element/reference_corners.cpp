#include <core/volume/element/reference_corners.hpp>

#include <cassert>

namespace elvis {

std::array<double, 3> reference_corner(elvis_shape shape, std::uint32_t corner) {
    using Corners = std::array<std::array<double, 3>, 8>;
    static constexpr Corners hexahedron = {
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
    // The pyramid's are the first five.
    static constexpr Corners prism = {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {-1, 1, 1}}};
    static constexpr Corners tetrahedron = {{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    static constexpr Corners quadrilateral = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
    static constexpr Corners triangle = {{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}};
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return hexahedron[corner];
    case ELVIS_SHAPE_PRISM:
    case ELVIS_SHAPE_PYRAMID:
        return prism[corner];
    case ELVIS_SHAPE_TETRAHEDRON:
        return tetrahedron[corner];
    case ELVIS_SHAPE_QUADRILATERAL:
        return quadrilateral[corner];
    default:
        return triangle[corner];
    }
}

std::string_view face_corners(elvis_shape shape, std::uint32_t local_face) {
    static constexpr std::array<std::string_view, 6> hexahedron = {"0123", "0154", "1265", "3267", "0374", "4567"};
    static constexpr std::array<std::string_view, 5> prism = {"0123", "014", "1254", "325", "0354"};
    static constexpr std::array<std::string_view, 5> pyramid = {"0123", "014", "124", "324", "034"};
    static constexpr std::array<std::string_view, 4> tetrahedron = {"012", "013", "123", "023"};
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return hexahedron.at(local_face);
    case ELVIS_SHAPE_PRISM:
        return prism.at(local_face);
    case ELVIS_SHAPE_PYRAMID:
        return pyramid.at(local_face);
    case ELVIS_SHAPE_TETRAHEDRON:
        return tetrahedron.at(local_face);
    case ELVIS_SHAPE_QUADRILATERAL:
        return "0123";
    default:
        return "012";
    }
}

} // namespace elvis
