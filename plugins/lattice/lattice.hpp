/**
 * @file lattice.hpp
 * A box of hexahedra whose vertices are moved, and fields on it; nothing is stored for each element.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::lattice {

using Point = std::array<double, 3>;
using Box = std::array<double, 6>;

/** In each direction of the box, for fields and for how far vertices are moved. */
struct Wave {
    std::string name;
    std::string unit;
    /** Periods over the box. */
    Point periods{};
    double amplitude = 1;
};

struct Description {
    Point lower{-1, -1, -1}, upper{1, 1, 1};
    /** Of elements. */
    std::array<std::uint64_t, 3> counts{1, 1, 1};
    /** Of vertices, as a share of an element's sides: below 0.25, so that Jacobians are positive. */
    double moved = 0;
    std::vector<Wave> fields;
};

/** x_d, as coefficients of xi1^a xi2^b xi3^c at index a + 2b + 4c, by direction d. */
using Mapping = std::array<std::array<double, 8>, 3>;
/** Coefficients of xi1^a xi2^b xi3^c at index a + 3b + 9c. */
using Quadratic = std::array<double, 27>;

/** Bounds of a quadratic over the hexahedron, rounding included: values, sum |df/dxi_i|, sum |d2f/dxi_i dxi_j|. */
struct QuadraticBounds {
    double lower, upper, slope, bend;
};
QuadraticBounds bounds_of(const Quadratic& f);

/**
 * Vertex (i, j, k) lies at lower + h (i, j, k), moved by m (h1 s2 s3, h2 s3 s1, h3 s1 s2) with h the sides of an element, m the
 * share `moved`, and s_d = sin(4 pi i_d / n_d). Fields are A (sin(p1 x) cos(p2 y) + sin(p2 y) cos(p3 z) + sin(p3 z) cos(p1 x))
 * in the box's own coordinates, interpolated in each element at three points in each direction.
 */
class Lattice {
public:
    explicit Lattice(const Description& description);

    std::uint64_t n_elements() const { return m_counts[0] * m_counts[1] * m_counts[2]; }
    const std::array<std::uint64_t, 3>& counts() const { return m_counts; }

    Mapping mapping(std::uint64_t element) const;
    /** Rounding included. */
    Box bounds(std::uint64_t element) const;
    Quadratic field(std::size_t field, std::uint64_t element) const;

private:
    std::array<std::uint64_t, 3> place(std::uint64_t element) const;
    Point vertex(const std::array<std::uint64_t, 3>& index) const;

    std::array<std::uint64_t, 3> m_counts;
    Point m_lower, m_sides{};
    double m_moved;
    /** s_d, by direction and index. */
    std::array<std::vector<double>, 3> m_shifts;
    struct Table {
        double amplitude;
        /** At all points of interpolation, by direction and index. */
        std::array<std::vector<double>, 3> sines, cosines;
    };
    std::vector<Table> m_fields;
};

} // namespace elvis::lattice
