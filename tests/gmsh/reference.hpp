/**
 * @file reference.hpp
 * Gmsh's reference elements as the manual gives them, written for the tests alone.
 */
#pragma once

#include "fixture.hpp"
#include "msh_mesh.hpp"

#include <array>
#include <map>
#include <vector>

/** Native reference point of Gmsh's corner. */
Point corner_of(int topology, int corner);

/** Gmsh's reference coordinates of a native point. */
Point gmsh_point(int topology, const Point& xi);

/**
 * Native reference points of all nodes of a type, found from an element of a straight mesh by its corners and the positions of
 * its nodes.
 */
std::vector<Point> nodes_from_straight(const MshMesh& mesh, const MshElement& element);

/** Where the nodes of a straight element lie, from its corners and the reference points of its nodes. */
std::vector<std::array<double, 3>> straight_positions(const MshMesh& mesh, const MshElement& element,
                                                      const std::vector<Point>& nodes);

/** Exponents (a, b, c) of the monomials that span a type's space (on pyramids with the powers of 1 - w, see monomial). */
std::vector<std::array<int, 3>> monomials(const TypeFacts& type);
double monomial(int topology, const std::array<int, 3>& exponents, const Point& xi);

/** A random function of a type's space, of size about 1. */
class SpaceFunction {
public:
    explicit SpaceFunction(const TypeFacts& type);
    double operator()(const Point& xi) const;

private:
    int m_topology;
    std::vector<std::array<int, 3>> m_exponents;
    std::vector<double> m_coefficients;
};
