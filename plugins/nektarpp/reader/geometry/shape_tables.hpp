/**
 * @file shape_tables.hpp
 * Local edges and faces of the reference shapes, and the modes of the modified basis that belong to them.
 *
 * Source: G. E. Karniadakis, S. J. Sherwin, "Spectral/hp Element Methods for CFD", ch. 3; README.md beside this file.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <array>
#include <span>

namespace nektarpp {

using elvis::native::Shape;

/** Indices p, q, r of a mode. */
using ModeIndex = std::array<std::uint32_t, 3>;

/** An edge from corner `from` to corner `to`, the direction in which its modes are counted. */
struct LocalEdge {
    int from = 0;
    int to = 0;
};

/**
 * One index of an entity's modes as a function of the bubble's indices (i, j):
 * constant + on_i * i + on_j * j.
 */
struct IndexRule {
    int constant = 0;
    int on_i = 0;
    int on_j = 0;
};
using ModeRule = std::array<IndexRule, 3>;

std::span<const LocalEdge> local_edges(Shape shape);

/** Modes i >= 2 of a local edge (j = 0). */
const ModeRule& edge_modes(Shape shape, int edge);

/**
 * Modes of a local face, with i along the first two corners of elvis::native::face_corners and j along the first and last;
 * quadrilaterals i, j >= 2, triangles i >= 2, j >= 1. In two dimensions the element is its own only face.
 */
const ModeRule& face_modes(Shape shape, int face);

/** Mode of a corner. */
ModeIndex corner_mode(Shape shape, int corner);

ModeIndex apply(const ModeRule& rule, std::uint32_t i, std::uint32_t j);

} // namespace nektarpp
