#include "cell_split.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <utility>

namespace generator {

namespace native = elvis::native;

namespace {

Vec3 position(CellCorner corner) {
    if (corner == cell_centre)
        return {0.5, 0.5, 0.5};
    return {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2 & 1)};
}

Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double determinant(const std::array<Vec3, 3>& a) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

// Corners that span the axes from corner 0.
std::array<std::size_t, 3> axis_corners(elvis_shape shape) {
    if (shape == ELVIS_SHAPE_TETRAHEDRON)
        return {1, 2, 3};
    return {1, 3, 4};
}

// Exchanges corners so that xi1 runs backwards. Collapsed vertices stay where they are.
void mirror(SubElement& element) {
    auto& c = element.corners;
    std::swap(c[0], c[1]);
    if (element.shape != ELVIS_SHAPE_TETRAHEDRON)
        std::swap(c[2], c[3]);
    if (element.shape == ELVIS_SHAPE_HEXAHEDRON) {
        std::swap(c[4], c[5]);
        std::swap(c[6], c[7]);
    }
}

void set_axes(SubElement& element) {
    const auto ends = axis_corners(element.shape);
    element.origin = position(element.corners[0]);
    for (std::size_t d = 0; d < 3; ++d)
        element.axes[d] = difference(position(element.corners[ends[d]]), element.origin);
}

SubElement make(elvis_shape shape, std::vector<CellCorner> corners, bool left_handed) {
    SubElement element{shape, std::move(corners), {}, {}, {}};
    set_axes(element);
    if ((determinant(element.axes) < 0) != left_handed) {
        mirror(element);
        set_axes(element);
    }
    const native::Shape reference{shape};
    for (int local_face = 0; local_face < native::n_faces(reference); ++local_face) {
        int side = -1;
        for (int d = 0; d < 3; ++d)
            for (int high = 0; high < 2; ++high)
                if (std::ranges::all_of(native::face_corners(reference, local_face), [&](int corner) {
                        const CellCorner at = element.corners[static_cast<std::size_t>(corner)];
                        return at != cell_centre && (at >> d & 1) == high;
                    }))
                    side = 2 * d + high;
        element.sides.push_back(side);
    }
    return element;
}

// The corners of a side: (0,0), (1,0), (1,1), (0,1) in its two directions, ascending.
std::array<CellCorner, 4> side_corners(int side) {
    const int normal = side / 2;
    const int base = (side % 2) << normal;
    const int first = 1 << (normal == 0 ? 1 : 0);
    const int second = 1 << (normal == 2 ? 1 : 2);
    return {base, base | first, base | first | second, base | second};
}

SubElement pyramid_on(int side, bool left_handed) {
    const auto [a, b, c, d] = side_corners(side);
    return make(ELVIS_SHAPE_PYRAMID, {a, b, c, d, cell_centre}, left_handed);
}

} // namespace

CellSplit one_hexahedron(bool left_handed) { return {make(ELVIS_SHAPE_HEXAHEDRON, {0, 1, 3, 2, 4, 5, 7, 6}, left_handed)}; }

CellSplit two_prisms(int direction, bool left_handed) {
    const int up = 1 << direction;
    const auto [low, first, high, second] = side_corners(2 * direction);
    CellSplit result;
    for (const CellCorner middle : {first, second})
        result.push_back(make(ELVIS_SHAPE_PRISM, {low, middle, middle | up, low | up, high, high | up}, left_handed));
    return result;
}

CellSplit six_tetrahedra(bool left_handed) {
    CellSplit result;
    for (const auto& [first, second] : {std::pair{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}})
        result.push_back(make(ELVIS_SHAPE_TETRAHEDRON, {0, 1 << first, 1 << first | 1 << second, 7}, left_handed));
    return result;
}

CellSplit six_pyramids(bool left_handed) {
    CellSplit result;
    for (int side = 0; side < 6; ++side)
        result.push_back(pyramid_on(side, left_handed));
    return result;
}

CellSplit five_pyramids_two_tetrahedra(int side, bool left_handed) {
    CellSplit result;
    for (int other = 0; other < 6; ++other)
        if (other != side)
            result.push_back(pyramid_on(other, left_handed));
    const auto [low, first, high, second] = side_corners(side);
    for (const CellCorner middle : {first, second})
        result.push_back(make(ELVIS_SHAPE_TETRAHEDRON, {low, middle, high, cell_centre}, left_handed));
    return result;
}

CellSplit corner_tetrahedron() { return {make(ELVIS_SHAPE_TETRAHEDRON, {0, 1, 2, 4}, false)}; }

} // namespace generator
