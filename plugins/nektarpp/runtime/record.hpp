/**
 * @file record.hpp
 * How the coefficients of a space lie in a record of a device buffer, for glsl/volume.glsl.
 *
 * They are those of the file, in its order; orthogonal modes are scaled so that their polynomials have Jacobi's own
 * normalisation. In hexahedra each r has a slab of its own, padded to rows of four numbers, so that a loop over slabs still
 * knows every position inside one at compile time; other shapes have one slab.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <span>
#include <vector>

namespace nektarpp {

using elvis::native::Space;

class Record {
public:
    /** `width` numbers a mode: 3 for the geometry, 1 for a field. */
    Record(const Space& space, std::size_t width);

    std::size_t slab_rows() const { return m_slab_rows; }
    /** Multiple of four. */
    std::size_t size() const { return m_size; }

    /** Coefficients of one of the `width` functions, less `constant`, to their places in a record. */
    void write(std::span<const double> coefficients, double constant, std::size_t which, double* record) const;

    /** Coefficients of the function 1. */
    const std::vector<double>& one() const { return m_one; }

private:
    std::size_t m_width, m_slab_rows = 0, m_size = 0;
    std::vector<std::size_t> m_places;
    std::vector<double> m_factors, m_one;
};

} // namespace nektarpp
