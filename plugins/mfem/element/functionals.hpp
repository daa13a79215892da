/**
 * @file functionals.hpp
 * What MFEM's degrees of freedom measure: values, tangential or normal components at nodes, in the order of MFEM's elements.
 *
 * Every shape function is dual to these functionals in the element's space, which defines it without MFEM's own bases. The
 * functionals of edges and faces are laid out in the frame of the edge's or face's vertices, so that neighbours agree.
 */
#pragma once

#include "../collection.hpp"
#include "geometry.hpp"

#include <vector>

namespace elvis_mfem {

/** The value at a node, or its product with `direction`, which is a tangent (ND), a normal (RT) or zero (scalar). */
struct Functional {
    Point node{};
    Point direction{};
};

/**
 * A functional of an edge or face, at f0 + s (f1 - f0) + t (f_last - f0). Tangent: ds (f1 - f0) + dt (f_last - f0); normals are
 * (f1 - f0) x (f_last - f0).
 */
struct FrameFunctional {
    double s = 0;
    double t = 0;
    double ds = 0;
    double dt = 0;
};

/** Functionals of an edge in the direction of its vertices: tangents (ND), or in the plane normals to the right of it (RT). */
std::vector<FrameFunctional> edge_functionals(const Collection& collection);

/** Functionals of a face with 3 or 4 corners. */
std::vector<FrameFunctional> face_functionals(const Collection& collection, int n_corners);

/** All functionals of an element: vertices, edges, faces, interior. */
std::vector<Functional> functionals(const Collection& collection, Geometry geometry);

} // namespace elvis_mfem
