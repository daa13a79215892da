/**
 * @file collection.hpp
 * Names of MFEM's finite element collections, such as H1_3D_P5, L2_T1_2D_P2, ND@UO_3D_P3.
 */
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace elvis_mfem {

enum class Family : std::uint8_t { h1, l2, nd, rt };

/** One-dimensional bases, numbered as MFEM's BasisType. All nodal on these points but the positive, which is Bernstein's. */
enum class Basis : std::uint8_t {
    gauss_legendre = 0,
    gauss_lobatto = 1,
    positive = 2,
    open_uniform = 3,
    closed_uniform = 4,
    open_half_uniform = 5
};

struct Collection {
    Family family = Family::h1;
    /** 1, 2 or 3; 0 fits any mesh. */
    int dimension = 0;
    /** The number after P: polynomial order of H1 and L2; Nedelec spaces of order p lie in order p, Raviart-Thomas in p + 1. */
    int order = 1;
    /** Basis of H1 and L2; closed basis of ND and RT. */
    Basis basis = Basis::gauss_lobatto;
    /** Open basis of ND and RT. */
    Basis open_basis = Basis::gauss_legendre;

    /** MFEM's first collection of order 3, whose hexahedra have the interior nodes in another order. */
    bool is_first_cubic = false;

    bool operator==(const Collection&) const = default;
    bool is_vector() const { return family == Family::nd || family == Family::rt; }
    /** Order of the polynomials that contain the space. */
    int polynomial_order() const { return family == Family::rt ? order + 1 : order; }
};

/** Highest polynomial_order() that is read. */
inline constexpr int max_order = 20;

/** Throws std::invalid_argument with the reason if the collection is not one of those read here. */
Collection parse_collection(std::string_view name);

/** The order of a name like NURBS3. Throws std::invalid_argument if there is none. */
int parse_nurbs_order(std::string_view name);

/** The n points of a nodal basis in [0, 1], ascending; n + 1 even ones from 0 to 1 stand for the positive basis of order n. */
std::vector<double> points(Basis basis, int n);

} // namespace elvis_mfem
