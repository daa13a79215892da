/**
 * @file nodal_space.hpp
 * A polynomial space on a reference shape whose functions are given by their values at as many nodes as it has dimensions.
 */
#pragma once

#include "matrix_cache.hpp"

#include <elvis/native/space.hpp>

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace elvis::nodal {

/**
 * The span of the native `orthogonal` basis of one order in all directions: each variable to that order in hexahedra and
 * quadrilaterals, total order in tetrahedra and triangles, their product in prisms; in pyramids the polynomials
 * P_i(a) P_j(b) (1-xi3)^(i+j) P_k(xi3) with k <= order - max(i, j).
 */
native::Space space_of_order(native::Shape shape, std::uint32_t order);

/** Dimension of that space. */
std::size_t n_functions(native::Shape shape, std::uint32_t order);

/**
 * The least order, from 0 to `most`, whose space has that many dimensions; -1 if there is none.
 */
int order_of(native::Shape shape, std::size_t n_functions, std::uint32_t most);

/** Any thread may use it. */
class NodalSpace {
public:
    /** `nodes`: three numbers each. Throws std::invalid_argument if they do not determine the functions of that order. */
    NodalSpace(native::Shape shape, std::uint32_t order, std::vector<double> nodes);

    native::Shape shape() const { return m_space.shape; }
    std::uint32_t order() const { return m_order; }
    std::size_t size() const { return m_nodes.size() / 3; }
    const std::vector<double>& nodes() const { return m_nodes; }

    /** Values at points from values at nodes: matrix * values. */
    std::shared_ptr<const Matrix> at(std::span<const double> xi) const;

private:
    Matrix modes(std::span<const double> xi) const;

    native::Space m_space;
    std::uint32_t m_order;
    std::vector<double> m_nodes;
    /** From values at nodes to coefficients of the orthogonal basis. */
    Eigen::MatrixXd m_to_modes;
    /** A cache for one space needs no key. */
    struct Nothing {
        friend bool operator==(const Nothing&, const Nothing&) = default;
    };
    mutable MatrixCache<Nothing> m_matrices;
};

/** Spaces that several files of a series have in common, made once. Any thread may use it. */
class NodalSpaces {
public:
    /** As the constructor of NodalSpace. */
    std::shared_ptr<const NodalSpace> get(native::Shape shape, std::uint32_t order, std::vector<double> nodes);

private:
    std::mutex m_mutex;
    std::vector<std::shared_ptr<const NodalSpace>> m_spaces;
};

} // namespace elvis::nodal
