/**
 * @file cell_kind.hpp
 * VTK's cell types, and what a cell's shape functions depend on.
 */
#pragma once

#include <elvis/element.h>

#include <array>
#include <compare>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace elvis_vtk {

/** Largest degree that is read. VTK itself goes to 10. */
inline constexpr int max_degree = 20;

/** Sets of shape functions. */
enum class Family : std::uint8_t {
    tensor,          ///< quadrilateral, hexahedron: products of polynomials in r, s, t
    simplex,         ///< triangle, tetrahedron: polynomials of one total degree
    wedge,           ///< triangle times line
    quadrilateral_8, ///< serendipity
    hexahedron_20,   ///< serendipity
    hexahedron_24,   ///< serendipity in r, s times quadratic in t
    wedge_15,        ///< serendipity
    triangle_7,      ///< quadratic and a bubble
    tetrahedron_15,  ///< quadratic, a bubble for each face and one inside
    wedge_21,        ///< triangle_7 times quadratic
    pyramid_5,       ///< bilinear in collapsed coordinates
    pyramid_13       ///< serendipity in collapsed coordinates
};

/** Cells of one kind have the same shape functions. */
struct CellKind {
    Family family = Family::tensor;
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    /** Along r, s, t. */
    std::array<std::uint8_t, 3> degree{1, 1, 1};
    /** A Lagrange or Bezier type: versions of VTK differ in the order of their nodes. */
    bool is_of_any_degree = false;
    /** Bernstein polynomials instead of Lagrange polynomials. */
    bool is_bezier = false;
    /** Lagrange polynomials on Gauss-Lobatto nodes, in quadrilaterals and hexahedra. */
    bool is_lobatto = false;
    /** Bezier with unequal weights. */
    bool is_rational = false;
    /** Wedge whose r and s are the native xi3 and xi1, instead of xi1 and xi3. */
    bool is_mirrored = false;

    friend auto operator<=>(const CellKind&, const CellKind&) = default;
};

int dimension(const CellKind& kind);
std::size_t n_nodes(const CellKind& kind);
/** Order of the native space that contains the functions (two more than the degree where they are rational: advice). */
std::array<std::uint32_t, 3> native_order(const CellKind& kind);
/** Node at each corner, in the order of elvis/element.h. */
std::array<std::uint8_t, 8> corner_nodes(const CellKind& kind);

/** Numbers of cell types that code elsewhere asks for. */
inline constexpr int type_pixel = 8, type_quad = 9, type_voxel = 11, type_hexahedron = 12, type_lagrange_hexahedron = 72,
                     type_bezier_hexahedron = 79;

/** Name of a type as VTK has it, with its number: "VTK_POLYHEDRON (42)". */
std::string type_name(int type);
/** Vertices, lines and curves. */
bool is_less_than_surface(int type);

/** A cell that cannot be read, with the reason. */
class UnsupportedCell : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/**
 * The kind of a cell with that type, number of points and, for Lagrange and Bezier cells, degrees from HigherOrderDegrees
 * (zeros if there are none). Pixels and voxels must have been turned into quadrilaterals and hexahedra.
 */
CellKind kind_of(int type, std::size_t n_points, const std::array<int, 3>& degrees);

} // namespace elvis_vtk
