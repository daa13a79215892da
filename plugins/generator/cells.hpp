/**
 * @file cells.hpp
 * How a cell of a block is cut into elements.
 *
 * Three kinds of cells, which conform face by face: a face is either left whole or cut into four triangles round its centre.
 *   hexahedron   all faces whole
 *   prisms       four prisms round the axis along w: the two faces across w are cut, the others whole
 *   star         every element has its last corner in the cell's centre: a whole face is the base of a pyramid, a cut one
 *                that of four tetrahedra
 * The collapsed corner of a triangular face is the centre of a face or cell wherever one takes part, so both sides agree.
 */
#pragma once

#include "blocks.hpp"

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <vector>

namespace generator {

/** One element of a cell: corners in the cell's coordinates [0,1]^3, in the order of elvis/element.h. */
struct Piece {
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    std::array<Vector3, 8> corners{};
    /** Which face of the cell each local face is part of, or -1. */
    std::array<int, 6> cell_face{-1, -1, -1, -1, -1, -1};
};

/** What a cell looks like. */
struct CellKind {
    enum class Type { hexahedron, prisms, star } type = Type::hexahedron;
    /** Faces of a star that are cut, one bit each. */
    unsigned cut_faces = 0;

    friend bool operator==(const CellKind&, const CellKind&) = default;
};

/**
 * The kind of a cell by the wanted shape and its layer in w. "mixed" runs through hexahedra, stars, prisms and tetrahedra along
 * w; around a core of tetrahedra it starts with prisms and ends with hexahedra. Needs min_mixed_layers layers.
 */
CellKind cell_kind(const std::string& shape, const Block& block, std::uint32_t layer, bool has_core);
inline constexpr std::uint32_t min_mixed_layers = 4;

const std::vector<Piece>& pieces(const CellKind& kind);

} // namespace generator
