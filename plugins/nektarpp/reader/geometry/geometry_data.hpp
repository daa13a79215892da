/**
 * @file geometry_data.hpp
 * What a geometry file says, by ids, before anything is put together.
 */
#pragma once

#include "../text/id_ranges.hpp"

#include <elvis/native/space.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace nektarpp {

using elvis::native::Shape;
using Position = std::array<double, 3>;

/** Where the points of a curve lie in its reference edge or face. */
enum class PointSet { evenly_spaced, gauss_lobatto, triangle_evenly_spaced, triangle_electrostatic, triangle_fekete };

/** Nodes on a curved edge or face. */
struct Curve {
    PointSet set = PointSet::evenly_spaced;
    /** Points along an edge. */
    std::uint32_t n_along = 0;
    std::vector<Position> points;
};

struct Face {
    /** Three or four edge ids, cyclic. */
    std::array<std::int64_t, 4> edges{};
    std::uint32_t n_edges = 0;
};

struct ElementRecord {
    Shape shape = Shape::hexahedron;
    std::int64_t id = 0;
    /** Ids of the faces, or of the edges in two dimensions, in local order. */
    std::array<std::int64_t, 6> sides{};
    /** Of the mesh. */
    std::uint32_t part = 0;
};

struct Composite {
    std::int64_t id = 0;
    std::string name;
    std::vector<IdGroup> groups;
};

struct GeometryData {
    /** The first file read, for errors that concern the whole. */
    std::string path;
    int dimension = 0;
    /** Third coordinates in the file mean nothing if this is 2. */
    int space_dimension = 0;
    std::unordered_map<std::int64_t, Position> vertices;
    std::unordered_map<std::int64_t, std::array<std::int64_t, 2>> edges;
    std::unordered_map<std::int64_t, Face> faces;
    /** In the order of the file. */
    std::vector<ElementRecord> elements;
    /** Files of a partitioned mesh that have been read; the last is being read. */
    std::uint32_t n_parts = 1;
    std::unordered_map<std::int64_t, Curve> edge_curves;
    std::unordered_map<std::int64_t, Curve> face_curves;
    std::vector<Composite> composites;
    /** Composites that the domain consists of; empty if the file names none. */
    std::vector<IdRange> domain;
};

/** Number of sides of an element: faces, or edges in two dimensions. */
std::uint32_t n_sides(Shape shape);

} // namespace nektarpp
