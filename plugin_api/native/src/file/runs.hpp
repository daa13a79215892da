/**
 * @file runs.hpp
 * Every mode of every space is a product of three one-dimensional factors. This file lists them in storage order.
 *
 * Coefficients whose factors differ in the fastest index only form a run. Values, gradients and Bernstein coefficients are all
 * sums over runs: sum of outer * mid * (sum over the run of coefficient * inner).
 */
#pragma once

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cstddef>

namespace elvis::native {

/** One-dimensional functions of z in [-1,1]; l = (1-z)/2, r = (1+z)/2, P Jacobi polynomials. */
enum class Kind {
    one,            ///< 1
    modified_a,     ///< l, r, l r P_{index-2}^{1,1}
    orthogonal_a,   ///< sqrt(index + 1/2) P_index
    gll_lagrange,   ///< Lagrange polynomial of Gauss-Lobatto-Legendre point `index`
    gauss_lagrange, ///< Lagrange polynomial of Gauss-Legendre point `index`
    modified_b,     ///< 1, r P_{index-1}^{2m-1,1}
    orthogonal_b,   ///< sqrt(m + index + 1) P_index^{2m+1,0}
    orthogonal_c    ///< sqrt(m + index + 3/2) P_index^{2m+2,0}
};

/** l(z)^power times a function of `kind`. */
struct Factor {
    Kind kind = Kind::one;
    int m = 0;
    int index = 0;
    int power = 0;
};

/**
 * `count` consecutive coefficients from `first`: their inner factors have index, index + 1, ... The directions are
 * inner = 1, mid = 2, outer = 3 in hexahedra (quadrilaterals: inner = 1, outer = 2) and inner = 3, mid = 2, outer = 1 in the
 * collapsed shapes (triangles: inner = 2, outer = 1).
 */
struct Run {
    std::size_t first = 0;
    int count = 0;
    Factor outer, mid, inner;
};

/** Kind of the functions of an uncollapsed direction. */
inline Kind uncollapsed_kind(Basis basis) {
    switch (basis) {
    case Basis::orthogonal:
        return Kind::orthogonal_a;
    case Basis::gll_lagrange:
        return Kind::gll_lagrange;
    case Basis::gauss_lagrange:
        return Kind::gauss_lagrange;
    case Basis::modified:
    case Basis::tensor:
        break;
    }
    return Kind::modified_a;
}

/** Whether the space is the constants. */
inline bool is_constant(const Space& space) { return (space.order[0] | space.order[1] | space.order[2]) == 0; }

namespace detail {

// Numbers the runs while they are emitted.
template <class Visit> class Emitter {
public:
    explicit Emitter(Visit& visit) : m_visit(visit) {}

    void operator()(int count, const Factor& outer, const Factor& mid, const Factor& inner) {
        if (count <= 0)
            return;
        m_visit(Run{m_first, count, outer, mid, inner});
        m_first += static_cast<std::size_t>(count);
    }

    /**
     * The modes (0, .., r), r < count, above the vertex or edge that collapses. Where r = 1 the factors of the collapsed
     * directions are replaced by 1 (`outer1`, `mid1`), so that one continuous mode belongs to the collapsed vertex.
     */
    void collapsed(int count, const Factor& outer, const Factor& mid, const Factor& outer1, const Factor& mid1) {
        (*this)(1, outer, mid, {Kind::modified_b, 1, 0, 1});
        (*this)(std::min(count - 1, 1), outer1, mid1, {Kind::modified_b, 1, 1, 0});
        (*this)(count - 2, outer, mid, {Kind::modified_b, 1, 1, 1});
    }

private:
    Visit& m_visit;
    std::size_t m_first = 0;
};

} // namespace detail

/** Calls visit(run) for all runs of a valid space in storage order. */
template <class Visit> void for_each_run(const Space& space, Visit&& visit) {
    detail::Emitter<Visit> emit(visit);
    const Factor one;
    if (is_constant(space)) {
        emit(1, one, one, one);
        return;
    }
    const bool modified = space.basis == Basis::modified;
    const Kind kind = uncollapsed_kind(space.basis);
    const auto a = [kind](int index) { return Factor{kind, 0, index, 0}; };
    const int n1 = static_cast<int>(space.order[0]) + 1;
    const int n2 = static_cast<int>(space.order[1]) + 1;
    const int n3 = static_cast<int>(space.order[2]) + 1;
    switch (space.shape) {
    case Shape::quadrilateral:
        for (int q = 0; q < n2; ++q)
            emit(n1, a(q), one, a(0));
        break;
    case Shape::hexahedron:
        for (int r = 0; r < n3; ++r)
            for (int q = 0; q < n2; ++q)
                emit(n1, a(r), a(q), a(0));
        break;
    case Shape::triangle:
        for (int p = 0; p < n1; ++p) {
            if (!modified)
                emit(n2 - p, a(p), one, {Kind::orthogonal_b, p, 0, p});
            else if (p == 0)
                emit.collapsed(n2, a(0), one, one, one);
            else
                emit(n2 - p, a(p), one, {Kind::modified_b, p, 0, p});
        }
        break;
    case Shape::prism:
        for (int p = 0; p < n1; ++p)
            for (int q = 0; q < n2; ++q) {
                if (!modified)
                    emit(n3 - p, a(p), a(q), {Kind::orthogonal_b, p, 0, p});
                else if (p == 0)
                    emit.collapsed(n3, a(0), a(q), one, a(q));
                else
                    emit(n3 - p, a(p), a(q), {Kind::modified_b, p, 0, p});
            }
        break;
    case Shape::pyramid:
        for (int p = 0; p < n1; ++p)
            for (int q = 0; q < n2; ++q) {
                const int larger = std::max(p, q);
                if (space.basis == Basis::tensor)
                    emit(n3, a(p), a(q), a(0));
                else if (!modified)
                    emit(n3 - larger, a(p), a(q), {Kind::orthogonal_c, p + q, 0, p + q});
                else if (larger == 0)
                    emit.collapsed(n3, a(0), a(0), one, one);
                else if (std::min(p, q) < 2)
                    emit(n3 - larger, a(p), a(q), {Kind::modified_b, larger, 0, larger});
                else
                    emit(n3 - larger, a(p), a(q), {Kind::modified_b, p + q - 1, 0, p + q - 2});
            }
        break;
    case Shape::tetrahedron:
        for (int p = 0; p < n1; ++p)
            for (int q = 0; q < n2 - p; ++q) {
                const int n = n3 - p - q;
                if (!modified)
                    emit(n, a(p), {Kind::orthogonal_b, p, q, p}, {Kind::orthogonal_c, p + q, 0, p + q});
                else if (p > 0)
                    emit(n, a(p), {Kind::modified_b, p, q, p}, {Kind::modified_b, p + q, 0, p + q});
                else if (q > 1)
                    emit(n, a(0), {Kind::modified_b, 1, q - 1, 1}, {Kind::modified_b, q, 0, q});
                else if (q == 1)
                    emit(n, one, {Kind::modified_b, 1, 1, 0}, {Kind::modified_b, 1, 0, 1});
                else
                    emit.collapsed(n, a(0), {Kind::modified_b, 1, 0, 1}, one, one);
            }
        break;
    }
}

/** Polynomial degree of a factor in z; `order` of its direction for Lagrange polynomials. */
inline int degree(const Factor& factor, std::uint32_t order) {
    switch (factor.kind) {
    case Kind::one:
        return 0;
    case Kind::modified_a:
        return std::max(factor.index, 1);
    case Kind::gll_lagrange:
    case Kind::gauss_lagrange:
        return static_cast<int>(order);
    case Kind::orthogonal_a:
    case Kind::modified_b:
    case Kind::orthogonal_b:
    case Kind::orthogonal_c:
        break;
    }
    return factor.index + factor.power;
}

/** Direction (0, 1, 2) of the outer, mid and inner factor. */
struct Directions {
    std::size_t outer, mid, inner;
};

inline Directions directions(Shape shape) {
    switch (shape) {
    case Shape::hexahedron:
        return {2, 1, 0};
    case Shape::quadrilateral:
        return {1, 2, 0};
    case Shape::triangle:
        return {0, 2, 1};
    case Shape::prism:
    case Shape::pyramid:
    case Shape::tetrahedron:
        break;
    }
    return {0, 1, 2};
}

} // namespace elvis::native
