/**
 * @file basis.hpp
 * Shape functions of cells in native reference coordinates.
 */
#pragma once

#include "cell_kind.hpp"
#include "node_order.hpp"

#include <span>
#include <vector>

namespace elvis_vtk {

/** The shape functions of one kind of cell, one a node. Immutable: any thread may evaluate. */
class Basis {
public:
    explicit Basis(const CellKind& kind);

    const CellKind& kind() const { return m_kind; }
    std::size_t size() const { return m_size; }

    /** Values at a point of elvis/element.h (3 numbers). Weights of rational cells are not applied. */
    void evaluate(const double* xi, std::span<double> values) const;

private:
    CellKind m_kind;
    std::size_t m_size;
    /** Of families tensor, simplex and wedge. */
    std::vector<LatticePoint> m_nodes;
};

} // namespace elvis_vtk
