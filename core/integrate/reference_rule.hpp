/**
 * @file reference_rule.hpp
 * Quadrature in reference coordinates: Gauss-Legendre points of boxes in the collapsed cube [-1,1]^d, mapped to an element, one
 * of its faces, or, in two dimensions, one of its edges.
 *
 * With n points a direction, polynomials of degree 2n - 1 in each collapsed coordinate are integrated exactly; up to 2 of that
 * are spent on what collapses (Karniadakis & Sherwin, "Spectral/hp Element Methods", section 4.1).
 */
#pragma once

#include <core/base/vector3.hpp>

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

inline constexpr unsigned most_gauss_points = 64;

/** Gauss-Legendre points and weights on [-1, 1]. */
struct GaussLine {
    std::vector<double> points, weights;
};
/** n from 1 to most_gauss_points. */
const GaussLine& gauss_line(unsigned n);

/** Points of an element, three numbers each, and what each stands for in reference coordinates. */
struct ReferencePoints {
    std::vector<double> xi;
    /** Of elements: the part of the reference measure, a number a point. */
    std::vector<double> weights;
    /**
     * Of faces and surfaces: the vector area, three numbers a point. Jacobian's cofactors take it to the vector area in the
     * world. Of edges: the vector along the edge, which the Jacobian takes to the world.
     */
    std::vector<double> vectors;
    bool has_edges = false;

    void clear();
    std::size_t size() const { return xi.size() / 3; }
};

/** A part of the collapsed cube. */
struct CollapsedBox {
    Vector3 middle{};
    double half_side = 1;
};

/** What a rule runs over: an element, or a face of it (an edge, in two dimensions). */
struct ElementPart {
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    /** Negative: the element itself. */
    int local_face = -1;

    /** Of the collapsed cube. */
    unsigned dimension() const;
};

/** Appends the points of the rule with n points a direction. Face's vectors point out of the reference shape. */
void append_gauss_points(const ElementPart& part, const CollapsedBox& box, unsigned n, ReferencePoints& points);

} // namespace elvis
