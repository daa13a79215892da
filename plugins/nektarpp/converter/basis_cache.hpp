/**
 * @file basis_cache.hpp
 * Matrices of mode values at points, kept because the same points recur for all elements of a kind.
 */
#pragma once

#include "../reader/field/mode_set.hpp"

#include <plugins/nodal/matrix_cache.hpp>

namespace nektarpp {

/** Row: point; column: mode in the order of coefficients. */
using ModeMatrix = elvis::nodal::Matrix;

/** May be used by several threads at once. */
class BasisCache {
public:
    /** Values of the modes at points, three numbers a point. */
    std::shared_ptr<const ModeMatrix> values(const ModeSet& modes, std::span<const double> xi);

private:
    elvis::nodal::MatrixCache<ModeSet> m_matrices;
};

} // namespace nektarpp
