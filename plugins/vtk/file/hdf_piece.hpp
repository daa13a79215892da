/**
 * @file hdf_piece.hpp
 * The parts of a VTKHDF file.
 */
#pragma once

#include "hdf_grid.hpp"
#include "piece.hpp"

#include <functional>

namespace elvis_vtk {

/** A part of a grid at a time step. The grid must outlive it. */
class HdfPiece : public Piece {
public:
    HdfPiece(const HdfGrid& grid, std::size_t step, const HdfPart& part)
        : Piece(part.n_points, part.n_cells), m_grid(grid), m_step(step), m_part(part) {}

    const std::string& path() const override { return m_grid.file().path(); }
    /** VTKHDF came with VTK 9. */
    bool declares_old_hexahedra() const override { return false; }
    Numbers points() const override;
    PieceCells cells() const override;
    std::vector<FieldArray> arrays(Section section) const override;
    std::string named_by(Section section, const char* attribute) const override;
    std::uint32_t mantissa_bits(Section section, const FieldArray& array) const override;
    std::vector<double> values(Section section, const FieldArray& array) const override;
    [[noreturn]] void fail(Section section, const std::string& what) const override;

private:
    std::vector<std::int64_t> integers(const char* name, std::uint64_t first, std::uint64_t count) const;

    const HdfGrid& m_grid;
    std::size_t m_step;
    HdfPart m_part;
};

/** Calls visit for every part of a step that has cells, of all grids of the file; gives TimeValue of the field data. */
std::optional<double> visit_hdf_pieces(const std::string& path, std::size_t step,
                                       const std::function<void(const Piece&)>& visit);

} // namespace elvis_vtk
