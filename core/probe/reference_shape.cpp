#include <core/probe/reference_shape.hpp>

#include <core/base/vector3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace elvis {

std::array<double, 6> face_excesses(elvis_shape shape, const Vector3& xi) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    const auto [x, y, z] = xi;
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return {-x - 1, x - 1, -y - 1, y - 1, -z - 1, z - 1};
    case ELVIS_SHAPE_PRISM:
        return {-x - 1, -y - 1, y - 1, -z - 1, x + z, none};
    case ELVIS_SHAPE_PYRAMID:
        return {-x - 1, -y - 1, -z - 1, x + z, y + z, none};
    case ELVIS_SHAPE_QUADRILATERAL:
        return {-x - 1, x - 1, -y - 1, y - 1, none, none};
    case ELVIS_SHAPE_TRIANGLE:
        return {-x - 1, -y - 1, x + y, none, none, none};
    default:
        assert(shape == ELVIS_SHAPE_TETRAHEDRON);
        return {-x - 1, -y - 1, -z - 1, x + y + z + 1, none, none};
    }
}

double reference_excess(elvis_shape shape, const Vector3& xi) { return std::ranges::max(face_excesses(shape, xi)); }

Vector3 project_into_shape(elvis_shape shape, const Vector3& xi) {
    auto [x, y, z] = xi;
    // The slanted faces first, along their normal; then the others in an order in which each clamp keeps what came before.
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return {std::clamp(x, -1.0, 1.0), std::clamp(y, -1.0, 1.0), std::clamp(z, -1.0, 1.0)};
    case ELVIS_SHAPE_PRISM: {
        const double slant = std::max(x + z, 0.0) / 2;
        x = std::clamp(x - slant, -1.0, 1.0);
        return {x, std::clamp(y, -1.0, 1.0), std::clamp(z - slant, -1.0, -x)};
    }
    case ELVIS_SHAPE_PYRAMID:
        z = std::clamp(z - std::max(std::max(x, y) + z, 0.0) / 2, -1.0, 1.0);
        return {std::clamp(x, -1.0, -z), std::clamp(y, -1.0, -z), z};
    default: {
        assert(shape == ELVIS_SHAPE_TETRAHEDRON);
        const double slant = std::max(x + y + z + 1, 0.0) / 3;
        x = std::clamp(x - slant, -1.0, 1.0);
        y = std::clamp(y - slant, -1.0, -x);
        return {x, y, std::clamp(z - slant, -1.0, -1 - x - y)};
    }
    }
}

Vector3 reference_centroid(elvis_shape shape) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return {0, 0, 0};
    case ELVIS_SHAPE_PRISM:
        return {-1.0 / 3, 0, -1.0 / 3};
    case ELVIS_SHAPE_PYRAMID:
        return {-0.25, -0.25, -0.5};
    default:
        assert(shape == ELVIS_SHAPE_TETRAHEDRON);
        return {-0.5, -0.5, -0.5};
    }
}

} // namespace elvis
