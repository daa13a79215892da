/**
 * @file enclosure.hpp
 * Regions that are known to contain a curved element, from its Bernstein form: a polynomial lies in the convex hull of its
 * Bernstein coefficients.
 */
#pragma once

#include "volume.hpp"

#include <array>
#include <vector>

namespace elvis::oracle {

/** x(eta) as control points of a tensor-product Bernstein patch over the cube of collapsed coordinates [-1,1]^3. */
struct Patch {
    std::array<std::uint32_t, 3> order{};
    /** Third direction slowest. */
    std::vector<Vector> points;

    Vector& at(std::size_t i, std::size_t j, std::size_t k) { return points[(k * (order[1] + 1) + j) * (order[0] + 1) + i]; }
    const Vector& at(std::size_t i, std::size_t j, std::size_t k) const {
        return points[(k * (order[1] + 1) + j) * (order[0] + 1) + i];
    }
    /** Halves in one direction (de Casteljau). */
    std::array<Patch, 2> split(std::size_t direction) const;
    /** Direction in which the control points lie farthest apart, measured in coordinates `to_reference` * x. */
    std::size_t longest_direction(const Matrix& to_reference) const;
};

struct Enclosure {
    Patch patch;
    Vector lower;
    Vector upper;
    /** The mapping at the centroid, and the inverse of its Jacobian there (zero if there is none). */
    Vector centre;
    Matrix to_reference;
    /** For each face, the largest normal . to_reference (x - centre) over the element. */
    std::array<double, 6> slab{};
    /** The Jacobian's determinant has both signs (or is zero) among samples: several points of the shape may map to one. */
    bool is_folded = false;

    /** False only if x is not in the element; margin in reference units. */
    bool may_contain(native::Shape shape, const Vector& x, double margin) const;
};

/** Margins for the rounding of the conversion to Bernstein form are included. */
std::vector<Enclosure> make_enclosures(const Volume& volume);

} // namespace elvis::oracle
