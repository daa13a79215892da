/**
 * @file piece.hpp
 * A part of a grid that has points and cells of its own, whatever kind of file it lies in.
 */
#pragma once

#include "numbers.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace elvis_vtk {

/** Parts of a piece: errors are about one of them. */
enum class Section { points, cells, point_data, cell_data };

/** Values at points or of cells that a file has. */
struct FieldArray {
    std::string name;
    std::uint32_t n_components = 1;
};

struct PieceCells {
    /** Points, numbered within the piece. */
    std::vector<std::int64_t> connectivity;
    /** Where the points of each cell end in `connectivity`. */
    std::vector<std::int64_t> ends;
    std::vector<std::int64_t> types;
};

/** Reads on demand. What is wrong with the file is an elvis::api::Error that names file and place. */
class Piece {
public:
    Piece(std::size_t n_points, std::size_t n_cells) : m_n_points(n_points), m_n_cells(n_cells) {}
    virtual ~Piece() = default;
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;

    std::size_t n_points() const { return m_n_points; }
    std::size_t n_cells() const { return m_n_cells; }

    virtual const std::string& path() const = 0;
    /** Whether the file's version says that hexahedra are in the node order of VTK 8. */
    virtual bool declares_old_hexahedra() const = 0;

    /** Three numbers a point. */
    virtual Numbers points() const = 0;
    /** Of all cells: `ends` and `types` have n_cells() entries, whose values are not checked. */
    virtual PieceCells cells() const = 0;

    /** Arrays of numbers, in the order of the file. The section is point_data or cell_data, as below. */
    virtual std::vector<FieldArray> arrays(Section section) const = 0;
    /** The array that an attribute such as RationalWeights names; empty if there is none. */
    virtual std::string named_by(Section section, const char* attribute) const = 0;
    /** Significant bits of an array's numbers. */
    virtual std::uint32_t mantissa_bits(Section section, const FieldArray& array) const = 0;
    /** All numbers of an array, component by component of each point or cell in turn. */
    virtual std::vector<double> values(Section section, const FieldArray& array) const = 0;

    /** Throws with file and place. */
    [[noreturn]] virtual void fail(Section section, const std::string& what) const = 0;

private:
    std::size_t m_n_points;
    std::size_t m_n_cells;
};

} // namespace elvis_vtk
