#include "cells.hpp"

#include <algorithm>
#include <map>

namespace generator {

namespace {

constexpr unsigned all_faces = 0x3f;
constexpr unsigned low_face = 1u << 0;  // w-
constexpr unsigned high_face = 1u << 5; // w+

constexpr std::array<Vector3, 8> cell_corners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
/** Corners of the faces as in elvis/element.h. */
constexpr std::array<std::array<std::size_t, 4>, 6> cell_faces = {
    {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {0, 3, 7, 4}, {4, 5, 6, 7}}};
constexpr Vector3 centre = {0.5, 0.5, 0.5};

Vector3 face_centre(std::size_t face) {
    Vector3 sum{};
    for (const std::size_t corner : cell_faces[face]) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum[axis] += 0.25 * cell_corners[corner][axis];
        }
    }
    return sum;
}

double volume_sign(const Vector3& o, const Vector3& a, const Vector3& b, const Vector3& c) {
    const auto minus = [](const Vector3& p, const Vector3& q) { return Vector3{p[0] - q[0], p[1] - q[1], p[2] - q[2]}; };
    const Vector3 x = minus(a, o), y = minus(b, o), z = minus(c, o);
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
}

Piece whole_cell() {
    Piece piece;
    piece.corners = cell_corners;
    piece.cell_face = {0, 1, 2, 3, 4, 5};
    return piece;
}

/** Four prisms whose collapsed edge (corners 4, 5) is the cell's axis along w. */
std::vector<Piece> prisms() {
    std::vector<Piece> result;
    // Edges of the bottom, counter-clockwise, with the side face they belong to.
    constexpr std::array<std::array<std::size_t, 2>, 4> edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
    constexpr std::array<int, 4> side = {1, 2, 3, 4};
    for (std::size_t edge = 0; edge < 4; ++edge) {
        const Vector3 a = cell_corners[edges[edge][0]], b = cell_corners[edges[edge][1]];
        const Vector3 a_top = cell_corners[edges[edge][0] + 4], b_top = cell_corners[edges[edge][1] + 4];
        Piece piece;
        piece.shape = ELVIS_SHAPE_PRISM;
        // Triangles lie across xi2: bottom (0, 1, 4), top (3, 2, 5). With b first the Jacobian is positive.
        piece.corners = {b, a, a_top, b_top, {0.5, 0.5, 0}, {0.5, 0.5, 1}, {}, {}};
        piece.cell_face = {side[edge], 0, -1, 5, -1, -1};
        result.push_back(piece);
    }
    return result;
}

std::vector<Piece> star(unsigned cut_faces) {
    std::vector<Piece> result;
    for (std::size_t face = 0; face < cell_faces.size(); ++face) {
        std::array<Vector3, 4> base{};
        for (std::size_t k = 0; k < 4; ++k) {
            base[k] = cell_corners[cell_faces[face][k]];
        }
        if ((cut_faces >> face & 1u) == 0) {
            if (volume_sign(base[0], base[1], base[3], centre) < 0) {
                std::swap(base[1], base[3]);
            }
            Piece piece;
            piece.shape = ELVIS_SHAPE_PYRAMID;
            piece.corners = {base[0], base[1], base[2], base[3], centre, {}, {}, {}};
            piece.cell_face = {static_cast<int>(face), -1, -1, -1, -1, -1};
            result.push_back(piece);
            continue;
        }
        const Vector3 middle = face_centre(face);
        for (std::size_t k = 0; k < 4; ++k) {
            Vector3 a = base[k], b = base[(k + 1) % 4];
            if (volume_sign(a, b, middle, centre) < 0) {
                std::swap(a, b);
            }
            Piece piece;
            piece.shape = ELVIS_SHAPE_TETRAHEDRON;
            piece.corners = {a, b, middle, centre, {}, {}, {}, {}};
            piece.cell_face = {static_cast<int>(face), -1, -1, -1, -1, -1};
            result.push_back(piece);
        }
    }
    return result;
}

/** Along w: hexahedra, a star that turns to cut faces, prisms, tetrahedra, and, if periodic, a star that turns back. */
CellKind mixed_layer(std::uint32_t layer, std::uint32_t n_layers, bool is_periodic) {
    const std::uint32_t n_free = n_layers - (is_periodic ? 2 : 1);
    const std::uint32_t n_hexahedra = std::max(1u, n_free / 3);
    const std::uint32_t n_prisms = std::max(1u, (n_free - n_hexahedra) / 2);
    if (layer < n_hexahedra) {
        return {CellKind::Type::hexahedron, 0};
    }
    if (layer == n_hexahedra) {
        return {CellKind::Type::star, high_face};
    }
    if (layer <= n_hexahedra + n_prisms) {
        return {CellKind::Type::prisms, 0};
    }
    if (is_periodic && layer + 1 == n_layers) {
        return {CellKind::Type::star, low_face};
    }
    return {CellKind::Type::star, all_faces};
}

/** Around a core of tetrahedra: prisms, a star that turns to whole faces, hexahedra. */
CellKind mixed_layer_around_core(std::uint32_t layer, std::uint32_t n_layers) {
    const std::uint32_t n_prisms = std::max(1u, (n_layers - 1) / 2);
    return layer < n_prisms    ? CellKind{CellKind::Type::prisms, 0}
           : layer == n_prisms ? CellKind{CellKind::Type::star, low_face}
                               : CellKind{CellKind::Type::hexahedron, 0};
}

} // namespace

CellKind cell_kind(const std::string& shape, const Block& block, std::uint32_t layer, bool has_core) {
    if (shape == "prism") {
        // The inner cube has no direction of its own: tetrahedra meet the cut faces of the prisms around it.
        return block.is_core ? CellKind{CellKind::Type::star, all_faces} : CellKind{CellKind::Type::prisms, 0};
    }
    if (shape == "tetrahedron") {
        return {CellKind::Type::star, all_faces};
    }
    if (shape == "pyramid") {
        return {CellKind::Type::star, 0};
    }
    if (shape == "mixed") {
        return block.is_core ? CellKind{CellKind::Type::star, all_faces}
               : has_core    ? mixed_layer_around_core(layer, block.n_cells[2])
                             : mixed_layer(layer, block.n_cells[2], block.is_periodic);
    }
    return {CellKind::Type::hexahedron, 0};
}

const std::vector<Piece>& pieces(const CellKind& kind) {
    static const std::vector<Piece> hexahedron = {whole_cell()};
    static const std::vector<Piece> four_prisms = prisms();
    static const std::map<unsigned, std::vector<Piece>> stars = {
        {0u, star(0)}, {low_face, star(low_face)}, {high_face, star(high_face)}, {all_faces, star(all_faces)}};
    return kind.type == CellKind::Type::hexahedron ? hexahedron
           : kind.type == CellKind::Type::prisms   ? four_prisms
                                                   : stars.at(kind.cut_faces);
}

} // namespace generator
