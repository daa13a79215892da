/**
 * @file device_space.hpp
 * The bases in which fields and geometry travel to the device, and how their coefficients lie in a record.
 *
 * The native volume has many bases; the device has one for each shape, chosen for accurate evaluation in single precision with
 * few operations and no division at collapsed vertices. T Chebyshev, P Legendre, J^a_r = P_r^{a,0} Jacobi polynomials;
 * t = (1 - xi3)/2; x_d = t eta_d is linear in xi.
 *
 *   hexahedron    T_p(xi1) T_q(xi2) T_r(xi3)
 *   prism         t^p P_p(x1/t) T_q(xi2) J^{2p+1}_r(xi3)                                        r <= R - p
 *   tetrahedron   s^p P_p(x1/s) t^q J^{2p+1}_q(x2/t) J^{2p+2q+2}_r(xi3)      s = (-xi2 - xi3)/2, p + q + r <= R, ...
 *   pyramid       1 (and B_p(eta1) B_q(eta2), if `tensor`), B_p(eta1) B_q(eta2) t^e J^{2e+2}_r(xi3)
 *
 * Pyramids: the functions without a power of t carry the value at the apex; for functions with a single value there only the
 * constant is not zero. B, e and the range of r depend on the native space:
 *
 *   tensor        B_p = C_p    e = 1                                                            r < R
 *   modified      B_p = C_p    e = 1 if p, q < 2;  p + q - 2 if p, q >= 2;  else max(p, q)      r <= R - max(p, q, 1)
 *   orthogonal    B_p = P_p    e = p + q (1 if p = q = 0)                                       r <= R - max(p, q, 1)
 *
 * with C_0 = 1, C_1 = eta, C_p = (1 - eta^2)/4 P_{p-2}^{1,1}(eta): the inner functions of Modified_A.
 *
 * A quadrilateral is a hexahedron of order 0 in xi3; a triangle is a prism of order 0 in xi2, whose xi3 is the triangle's xi2.
 *
 * A record holds slabs, each padded to rows of four numbers, so that the shader can loop over slabs and still know every
 * position inside one at compile time.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstddef>
#include <cstdint>

namespace elvis::native::device {

struct DeviceSpace {
    /** Of three dimensions. */
    Shape shape = Shape::hexahedron;
    /** Pyramids: tensor, modified or orthogonal; without meaning elsewhere. */
    Basis basis = Basis::modified;
    int p_max = 0, q_max = 0, r_max = 0;

    explicit DeviceSpace(const Space& space);

    /** Number of indices q for this p; 0 beyond. */
    int n_q(int p) const;
    /** Number of functions in the third direction. Where has_apex, r = 0 is the function 1. */
    int n_r(int p, int q) const;
    bool has_apex(int p, int q) const;
    /** Whether a and b are C_p rather than P_p: some pyramids. */
    bool has_inner_functions() const { return shape == Shape::pyramid && basis != Basis::orthogonal; }
    /** Power of t that multiplies a third factor of a pyramid. */
    int exponent(int p, int q) const;

    /** The three factors at collapsed coordinates; all functions are a(p, eta1) b(p, q, eta2) c(p, q, r, eta3). */
    double a(int p, double eta1) const;
    double b(int p, int q, double eta2) const;
    double c(int p, int q, int r, double eta3) const;

    /** Slabs are counted by r in hexahedra, q in prisms, p in tensor pyramids; else there is one. */
    std::size_t n_slabs() const;
    std::size_t slab_size() const;
    std::size_t n_modes() const { return n_slabs() * slab_size(); }
    /** Rows of four numbers that a slab with `width` interleaved numbers a mode takes. */
    std::size_t slab_rows(std::size_t width) const { return (slab_size() * width + 3) / 4; }
    std::size_t n_rows(std::size_t width) const { return n_slabs() * slab_rows(width); }
};

} // namespace elvis::native::device
