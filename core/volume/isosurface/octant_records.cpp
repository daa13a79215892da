#include <core/base/vector3.hpp>
#include <core/volume/isosurface/octant_records.hpp>

#include <algorithm>

namespace elvis {

namespace {

/** shaders/isosurface/octant.glsl */
constexpr std::uint32_t octant_place_bits = 6;

/** Whether an octant with this lower corner shares more than an edge with the shape. */
bool is_in_shape(elvis_shape shape, const Vector3& corner) {
    switch (shape) {
    case ELVIS_SHAPE_TETRAHEDRON:
        return corner[0] + corner[1] + corner[2] < -1;
    case ELVIS_SHAPE_PRISM:
        return corner[0] + corner[2] < 0;
    case ELVIS_SHAPE_PYRAMID:
        return std::max(corner[0], corner[1]) + corner[2] < 0;
    default:
        return true;
    }
}

} // namespace

bool can_divide(std::uint32_t code) { return (code & 7u) < octant_place_bits; }

void add_octants(std::vector<std::uint32_t>& elements_and_codes, std::uint32_t element, std::uint32_t code, elvis_shape shape) {
    const std::uint32_t level = (code & 7u) + 1;
    const double side = 2.0 / (1u << level);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        std::uint32_t its_code = level;
        Vector3 corner{};
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t shift = 3 + k * octant_place_bits;
            const std::uint32_t place = 2 * ((code >> shift) & ((1u << octant_place_bits) - 1)) + (octant >> k & 1u);
            its_code |= place << shift;
            corner[k] = -1 + side * place;
        }
        if (is_in_shape(shape, corner)) {
            elements_and_codes.insert(elements_and_codes.end(), {element, its_code});
        }
    }
}

} // namespace elvis
