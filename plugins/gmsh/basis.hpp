/**
 * @file basis.hpp
 * Functions that interpolate values of an element's nodes: Gmsh's Lagrange bases on equispaced nodes, and bases given in a
 * file.
 */
#pragma once

#include "element_type.hpp"
#include "lattice.hpp"

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gmsh {

/** Native corner `c` of a shape is the source's corner `source_corners(topology)[c]`. */
std::span<const int> source_corners(Topology topology);

/**
 * Gmsh's reference coordinates (u, v, w) of a native reference point. The map keeps the orientation: elements that are not
 * inside out in Gmsh are not inside out here.
 */
std::array<double, 3> source_point(Topology topology, const double* xi);

/** Functions on a reference element, as many as there are values. Immutable. */
class Basis {
public:
    Basis();
    virtual ~Basis() = default;
    Basis(const Basis&) = delete;
    Basis& operator=(const Basis&) = delete;

    Topology topology() const { return m_topology; }
    /** Number of functions. */
    std::size_t size() const { return m_size; }
    /** Orders of the smallest native space that contains all functions. */
    const std::array<std::uint32_t, 3>& native_order() const { return m_native_order; }

    /**
     * The functions at points in native reference coordinates (3 numbers a point): a row a point, a column a function. The host
     * asks for the same points again and again: each thread keeps its last answers, and the reference is valid until the
     * thread's next call.
     */
    const Eigen::MatrixXd& weights(std::span<const double> xi) const;

protected:
    void describe(Topology topology, std::size_t size, const std::array<std::uint32_t, 3>& native_order) {
        m_topology = topology;
        m_size = size;
        m_native_order = native_order;
    }

private:
    /** Values of all functions at points (columns) given in Gmsh's coordinates. */
    virtual Eigen::MatrixXd evaluate(const Eigen::Matrix3Xd& points) const = 0;

    /** Tells kept answers of different objects apart, of those that are gone too. */
    std::uint64_t m_serial;
    Topology m_topology = Topology::point;
    std::size_t m_size = 0;
    std::array<std::uint32_t, 3> m_native_order{};
};

/** The Lagrange basis of an element type. Serendipity pyramids above order 2 have none, see `has_lagrange_basis`. */
std::unique_ptr<Basis> lagrange_basis(const ElementType& type);

/** Gmsh defines no functions for serendipity pyramids above order 2; points and lines are not interpolated here. */
bool has_lagrange_basis(const ElementType& type);

/** The constant 1. */
std::unique_ptr<Basis> constant_basis(Topology topology);

} // namespace gmsh
