/**
 * @file mesh.hpp
 * A mesh as the files hold it, and how it is read.
 */
#pragma once

#include "collection.hpp"
#include "element/geometry.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis_mfem {

class Text;
struct NurbsPatches;
struct Segments;

struct MeshElement {
    int attribute = 1;
    Geometry geometry = Geometry::cube;
    /** In MFEM's order; the rest is -1. */
    std::array<std::int32_t, 8> vertices{-1, -1, -1, -1, -1, -1, -1, -1};
};

struct BoundaryElement {
    int attribute = 1;
    /** Two of a segment, three of a triangle; the rest is -1. */
    std::array<std::int32_t, 4> vertices{-1, -1, -1, -1};
};

struct AttributeSet {
    std::string name;
    std::vector<int> attributes;
};

/** A grid function: values of degrees of freedom, in the numbering of the whole mesh. */
struct GridFunction {
    Collection collection;
    /** Of NURBS, which have no collection; else 0. */
    int nurbs_order = 0;
    int n_components = 1;
    /** Components of one degree of freedom side by side (MFEM's byVDIM), or one component after the other (byNODES). */
    bool is_interleaved = false;
    std::vector<double> values;
};

struct Mesh {
    /** Of the elements, 2 or 3; 1 before a curve becomes a band. */
    int dimension = 3;
    /** Coordinates of a point in the file; more than the dimension in surfaces in space. */
    int space_dimension = 3;
    std::vector<MeshElement> elements;
    std::vector<BoundaryElement> boundary;
    std::vector<AttributeSet> boundary_sets;
    std::size_t n_vertices = 0;
    /** Three numbers a vertex, the third 0 in the plane; empty if there are nodes. */
    std::vector<double> coordinates;
    std::optional<GridFunction> nodes;
    /** Of GLVis streams, which hold both. */
    std::optional<GridFunction> solution;
    /** Of NURBS meshes. */
    std::shared_ptr<const NurbsPatches> nurbs;
    /** Of bands, which meshes of segments are read as (band.hpp). */
    std::shared_ptr<const Segments> segments;
    /** Most significant decimal digits of the coordinates. */
    int digits = 0;
};

/** Whether a file begins like one of MFEM's meshes, compressed or not. */
bool is_mesh(const char* path);

/** Reads a mesh of any version that is supported. */
Mesh read_mesh(const std::string& path);

/** Reads the sections of a nonconforming mesh, from behind its first line (nc_mesh.cpp). */
Mesh read_nonconforming(Text& text, bool has_scales);

/** Reads a NURBS mesh, from behind its first line (nurbs/nurbs_mesh.cpp). */
Mesh read_nurbs(Text& text);

/** Makes the mesh that the lines of an INLINE mesh describe (inline_mesh.cpp). */
Mesh read_inline(Text& text);

/** Reads a space and the values, as in files of solutions and in the section `nodes` of a mesh. */
GridFunction read_grid_function(Text& text);

/** A whole file of a solution. */
GridFunction read_solution(const std::string& path, int* digits);

/** Parts that both kinds of meshes share. */
int read_dimension(Text& text, int least = 2);
/** The geometry of an element of that dimension. */
Geometry read_geometry(Text& text, int dimension);
BoundaryElement read_boundary_element(Text& text, int dimension, std::int64_t n_vertices);
/** The number of coordinates, then `n_vertices` points: three numbers each. */
std::vector<double> read_coordinates(Text& text, std::size_t n_vertices, int dimension, int* space_dimension);
/** Nodes if they come next. */
void read_nodes(Text& text, Mesh& mesh);
/** Nodes without their heading. */
void take_nodes(Text& text, Mesh& mesh);

} // namespace elvis_mfem
