/**
 * @file cell_split.hpp
 * How one hexahedral cell is cut into elements.
 *
 * A cell is the unit cube with coordinates c in [0,1]^3. All its cuts are by planes, so that every element is an affine image
 * of its reference shape in c, whatever the cell's own shape in space is. Neighbouring cells agree because a cut face is always
 * cut from its corner (0,0) to its corner (1,1), and cells count coordinates along the same mesh lines in the same direction.
 *
 * Triangular faces agree on their collapsed vertex, as Nektar++ asks for: corners are ordered along the mesh lines, the centre
 * of a cell after all its corners, and the vertex that comes last is the collapsed one (the tetrahedra of a cell are those of
 * H. W. Kuhn, "Some combinatorial lemmas in topology", 1960).
 */
#pragma once

#include <elvis/element.h>

#include <array>
#include <vector>

namespace generator {

using Vec3 = std::array<double, 3>;

/** Corner of a cell by bits: bit d says whether c_d is 1. */
using CellCorner = int;
inline constexpr CellCorner cell_centre = 8;

/** One element of a cell. */
struct SubElement {
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    /** In the order of elvis/element.h. */
    std::vector<CellCorner> corners;
    /** c = origin + sum over d of (1 + xi_d)/2 axes[d]. */
    Vec3 origin{};
    std::array<Vec3, 3> axes{};
    /** Side of the cell in which each local face lies, 2 d + (c_d == 1), or -1. */
    std::vector<int> sides;
};

using CellSplit = std::vector<SubElement>;

// For a left-handed cell (det dx/dc < 0) the elements are mirrored, so that their own Jacobians are positive.

CellSplit one_hexahedron(bool left_handed);
/** Two prisms with their triangles in the two faces normal to `direction`. */
CellSplit two_prisms(int direction, bool left_handed);
/** Kuhn's six tetrahedra around the diagonal from (0,0,0) to (1,1,1). */
CellSplit six_tetrahedra(bool left_handed);
/** One pyramid on each side, apex in the centre. */
CellSplit six_pyramids(bool left_handed);
/** As six_pyramids, but two tetrahedra in the place of the pyramid on `side`: joins hexahedra to tetrahedra. */
CellSplit five_pyramids_two_tetrahedra(int side, bool left_handed);
/** One tetrahedron with its corners at the cell's (0,0,0), (1,0,0), (0,1,0) and (0,0,1). */
CellSplit corner_tetrahedron();

} // namespace generator
