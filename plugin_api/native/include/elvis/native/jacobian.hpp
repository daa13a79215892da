/**
 * @file jacobian.hpp
 * Where is the Jacobian determinant of an element negative? Certified answers for mappings of the native spaces.
 *
 * The determinant is that of dx/dxi, xi being the reference coordinates. In collapsed coordinates eta it is a polynomial over a
 * cube, in every shape and basis, and its Bernstein coefficients bound it. (det dx/deta differs by the factor of the collapse,
 * which is positive inside and zero at the collapsed edge or vertex: of no use for a sign.) In prisms and tetrahedra det dx/dxi
 * is a polynomial in xi, and the collapsed edge or vertex is a place like any other. In pyramids (but those of `orthogonal`
 * basis) it is rational, and at the apex its limit depends on the direction: all limits count, so that an element whose limit
 * is negative along some direction is negative, and the witness is a point close to the apex.
 *
 * `tensor` pyramids must be continuous at the apex (format.md). Where coefficients break that by no more than 1e-9 of the
 * element's size, what they break it by is taken as rounding and left out; by more, nothing is said (undecided, lower -inf).
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis::native {

/** Same numbers as elvis_jacobian_sign in elvis/runtime.h. */
enum class JacobianSign : std::uint32_t {
    positive,  ///< at every point of the closed shape, the exact determinant is greater than zero
    negative,  ///< less than zero at `xi`
    undecided, ///< neither is proven within the tolerance
};

struct JacobianCheck {
    JacobianSign sign = JacobianSign::undecided;
    /** No exact determinant of the element is smaller; -inf if nothing is known, NaN if negative. */
    double lower = 0;
    /** Where the determinant is negative; where the smallest was seen if undecided; NaN if positive. */
    Point xi{};
    /** There, rounded; NaN if positive. */
    double determinant = 0;
};

struct JacobianOptions {
    /**
     * Of the determinant, over its largest Bernstein coefficient in the element: an element whose smallest determinant lies
     * within it of zero may remain undecided. What rounding leaves open is undecided at any tolerance.
     */
    double tolerance = 1e-9;
    /**
     * Parts that an element may be divided into before it is left undecided. Some tens suffice unless the smallest determinant
     * is close to zero along a whole line or surface inside the element.
     */
    std::size_t max_parts = 4096;
};

/**
 * Checks many elements of one geometry space. Two stages: if, after a change of basis, the columns' Bernstein coefficients are
 * dominated by their diagonal, then so is the Jacobian everywhere, and its determinant is positive (fast; most elements of a
 * usable mesh); else the determinant's own Bernstein form decides, divided where it must be (de Casteljau). All rounding is
 * accounted for: the answers hold for the exact polynomial with the given coefficients.
 *
 * One thread at a time; copies are independent.
 */
class JacobianChecker {
public:
    /** A space of a three-dimensional shape, of order 1 at least; else std::invalid_argument. */
    explicit JacobianChecker(const Space& geometry, const JacobianOptions& options = {});
    ~JacobianChecker();
    JacobianChecker(const JacobianChecker&);
    JacobianChecker& operator=(const JacobianChecker&);

    /** coefficients[(element * 3 + direction) * n_modes + mode]; one check an element. */
    void operator()(std::span<const double> coefficients, std::span<JacobianCheck> checks);

private:
    class Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::native
