/**
 * @file finite_volume.hpp
 * Cells of finite-volume elements, into which FLEXI and GALAEXI change elements at shocks.
 */
#pragma once

#include <plugins/nodal/nodal_space.hpp>

#include <span>
#include <vector>

namespace elvis_hopr {

/** N+1 cells in each direction. */
class FiniteVolumeCells {
public:
    /** Widths of the cells on [-1, 1], which they fill. */
    explicit FiniteVolumeCells(const std::vector<double>& widths);

    /** Matrix: values at points from values in cells, i fastest. */
    elvis::nodal::Matrix at(std::span<const double> xi) const;

private:
    std::size_t cell(double x) const;

    /** Upper ends. */
    std::vector<double> m_ends;
};

} // namespace elvis_hopr
