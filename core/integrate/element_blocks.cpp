#include <core/integrate/element_blocks.hpp>

#include <elvis/native/space.hpp>

#include <cassert>
#include <initializer_list>

namespace elvis {

namespace {

Vector3 middle(std::initializer_list<Vector3> points) {
    Vector3 sum{};
    for (const Vector3& point : points) {
        sum = plus(sum, point);
    }
    return scaled(sum, 1.0 / static_cast<double>(points.size()));
}

/** The part of a tetrahedron that is nearest to its first corner. */
ElementBlock corner_block(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return {{a, middle({a, b}), middle({a, c}), middle({a, b, c}), middle({a, d}), middle({a, b, d}), middle({a, c, d}),
             middle({a, b, c, d})}};
}

void append_tetrahedron(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                        std::vector<ElementBlock>& blocks) {
    blocks.push_back(corner_block(a, b, c, d));
    blocks.push_back(corner_block(b, c, a, d));
    blocks.push_back(corner_block(c, a, b, d));
    blocks.push_back(corner_block(d, b, a, c));
}

/** The part of a prism that is nearest to one of the edges between its triangles; a, b and c: corners of one triangle. */
ElementBlock edge_block(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& along) {
    ElementBlock block{{a, middle({a, b}), middle({a, c}), middle({a, b, c}), {}, {}, {}, {}}};
    for (std::size_t corner = 0; corner < 4; ++corner) {
        block.corners[4 + corner] = plus(block.corners[corner], along);
    }
    return block;
}

} // namespace

ElementBlock::Place ElementBlock::at(const Vector3& s) const {
    Place place;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::array<double, 3> factors{}, changes{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_upper = ((corner >> axis) & 1) != 0;
            factors[axis] = is_upper ? s[axis] : 1 - s[axis];
            changes[axis] = is_upper ? 1 : -1;
        }
        const Vector3& at = corners[corner];
        place.xi = plus(place.xi, scaled(at, factors[0] * factors[1] * factors[2]));
        place.tangents[0] = plus(place.tangents[0], scaled(at, changes[0] * factors[1] * factors[2]));
        place.tangents[1] = plus(place.tangents[1], scaled(at, factors[0] * changes[1] * factors[2]));
        place.tangents[2] = plus(place.tangents[2], scaled(at, factors[0] * factors[1] * changes[2]));
    }
    return place;
}

std::vector<ElementBlock> element_blocks(elvis_shape shape) {
    std::vector<Vector3> c;
    for (int corner = 0; corner < native::n_corners(native::Shape{shape}); ++corner) {
        c.push_back(native::corner(native::Shape{shape}, corner));
    }
    constexpr Vector3 up{0, 0, 1};
    std::vector<ElementBlock> blocks;
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        blocks.push_back({{c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]}});
        break;
    case ELVIS_SHAPE_PRISM:
        // The triangles are 0 1 4 and 3 2 5.
        blocks.push_back(edge_block(c[0], c[1], c[4], minus(c[3], c[0])));
        blocks.push_back(edge_block(c[1], c[4], c[0], minus(c[3], c[0])));
        blocks.push_back(edge_block(c[4], c[0], c[1], minus(c[3], c[0])));
        break;
    case ELVIS_SHAPE_PYRAMID:
        append_tetrahedron(c[0], c[1], c[2], c[4], blocks);
        append_tetrahedron(c[0], c[2], c[3], c[4], blocks);
        break;
    case ELVIS_SHAPE_QUADRILATERAL:
        blocks.push_back({{c[0], c[1], c[3], c[2], plus(c[0], up), plus(c[1], up), plus(c[3], up), plus(c[2], up)}});
        break;
    case ELVIS_SHAPE_TRIANGLE:
        blocks.push_back(edge_block(c[0], c[1], c[2], up));
        blocks.push_back(edge_block(c[1], c[2], c[0], up));
        blocks.push_back(edge_block(c[2], c[0], c[1], up));
        break;
    default:
        assert(shape == ELVIS_SHAPE_TETRAHEDRON);
        append_tetrahedron(c[0], c[1], c[2], c[3], blocks);
    }
    return blocks;
}

} // namespace elvis
