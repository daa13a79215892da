/**
 * @file written_hexahedra.hpp
 * A row of Lagrange hexahedra with a field whose values are known, as files. Written with nothing of those who read them.
 */
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/** Every cell has points of its own. Coordinates r of a cell lie in [0,1]. */
struct Hexahedra {
    using Vector = std::array<double, 3>;

    int degree = 3;
    std::size_t n_cells = 4;
    /** degree + 1 positions in [0,1] of nodes on a line. */
    std::vector<double> line;
    /** Position of a point of the row, whose cells are unit cubes along x. */
    std::function<Vector(const Vector&)> map = [](const Vector& x) { return x; };

    /** A polynomial of the cells' degree in each direction, another one in each cell and at each time. */
    double field(std::size_t cell, const Vector& r, double time) const;

    std::size_t n_nodes() const;
    std::vector<double> points() const;
    std::vector<double> values(double time) const;

private:
    /** visit(node, r) for each node of a cell in VTK's order. */
    void for_each_node(const std::function<void(std::size_t, const Vector&)>& visit) const;
};

std::vector<double> equidistant_line(int degree);
std::vector<double> lobatto_line(int degree);
std::vector<double> chebyshev_line(int degree);

/** A smooth map that bends all edges. */
Hexahedra::Vector bent(const Hexahedra::Vector& x);

void write_vtu(const std::string& path, const Hexahedra& cells, double time = 0);

/** How a VTKHDF file is laid out. */
struct HdfLayout {
    /** The first part has one cell, the second the others. */
    std::size_t n_parts = 2;
    /** Empty: a file without steps. */
    std::vector<double> times{};
    /** Whether each step has the mesh again. */
    bool repeats_mesh = false;
    /** Whether Steps/NumberOfParts is there; if not, steps that do not repeat the mesh have entries of zero for it. */
    bool has_number_of_parts = true;
    bool is_single = false;
    std::string group = "VTKHDF";
    std::string type = "UnstructuredGrid";
};

void write_vtkhdf(const std::string& path, const Hexahedra& cells, const HdfLayout& layout);
/** The same as two data sets of a collection, the second moved by 100 along x. */
void write_collection(const std::string& path, const Hexahedra& cells, const HdfLayout& layout);
