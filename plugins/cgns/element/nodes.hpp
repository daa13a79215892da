/**
 * @file nodes.hpp
 * Where the nodes of elements lie, in the order of files: the numbering conventions of the SIDS (format.md, section 3).
 */
#pragma once

#include "element_type.hpp"

#include <array>
#include <span>
#include <vector>

namespace elvis_cgns {

/**
 * Coordinates of elements, in the names of format.md. Triangles r, s and tetrahedra r, s, t: from 0, with r + s + t <= 1.
 * Quadrilaterals and hexahedra: from -1 to 1. Prisms: those of a triangle, and t from -1 to 1. Pyramids: x, y from -(1 - w)
 * to 1 - w, and the height w from 0 to 1.
 */
using Point = std::array<double, 3>;

/** By corners, counted from 0. */
struct Face {
    int n_corners;
    std::array<int, 4> corners;
};

struct Parts {
    std::vector<Point> corners;
    std::vector<std::array<int, 2>> edges;
    /** Of triangles and quadrilaterals, the element itself. */
    std::vector<Face> faces;
};

const Parts& parts(Topology topology);

/** Nodes inside the volume: none of elements of fewer dimensions. */
std::size_t n_inner_nodes(Topology topology, int order);

/** Of triangles to hexahedra. */
std::vector<Point> nodes(const ElementType& type);

/** Coordinates of this page of a point of elvis/element.h. */
Point source_point(Topology topology, const double* xi);

/** Which corner of the file's each corner of elvis/element.h is. */
std::span<const int> source_corners(Topology topology);

} // namespace elvis_cgns
