/**
 * @file search_starts.hpp
 * Where Newton's method begins for many targets in one element.
 */
#pragma once

#include <core/probe/newton.hpp>

#include <cstddef>
#include <vector>

namespace elvis {

/**
 * Where the linear model about a point of a lattice near to the target has it: one evaluation of the mapping a point of the
 * lattice saves several a target. With few targets that is the centroid, which takes no evaluations.
 */
class SearchStarts {
public:
    SearchStarts(elvis_shape shape, const MappingFunction& mapping, std::size_t n_targets);

    /** A point of the shape. */
    Vector3 start(const Vector3& target) const;

private:
    double coordinate(std::size_t index) const;
    std::size_t index(double xi) const;

    elvis_shape m_shape;
    /** Points along each direction; less than 2: no lattice. */
    std::size_t m_size = 0;
    /** Of each point: three coordinates, where it lies, and the inverse of the Jacobian there. */
    std::vector<double> m_points, m_positions, m_inverses;
};

} // namespace elvis
