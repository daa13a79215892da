/**
 * @file spanning_set.hpp
 * Well conditioned functions that span the spaces of MFEM's elements, on its reference shapes.
 */
#pragma once

#include "../collection.hpp"
#include "geometry.hpp"

#include <cstddef>
#include <memory>

namespace elvis_mfem {

class SpanningSet {
public:
    virtual ~SpanningSet() = default;
    SpanningSet(const SpanningSet&) = delete;
    SpanningSet& operator=(const SpanningSet&) = delete;

    std::size_t size() const { return m_size; }
    std::size_t n_components() const { return m_n_components; }
    /** values[component * size() + function]. */
    virtual void evaluate(const Point& x, double* values) const = 0;

protected:
    SpanningSet(std::size_t size, std::size_t n_components) : m_size(size), m_n_components(n_components) {}

private:
    std::size_t m_size;
    std::size_t m_n_components;
};

/** Polynomials of total degree `order`. */
std::unique_ptr<const SpanningSet> make_triangle_set(int order);
std::unique_ptr<const SpanningSet> make_tetrahedron_set(int order);

/** Nedelec and Raviart-Thomas spaces of triangles, tetrahedra and prisms. */
std::unique_ptr<const SpanningSet> make_vector_set(const Collection& collection, Geometry geometry);

/**
 * The H1 space of the pyramid after Fuentes, Keith, Demkowicz, Nagaraj, "Orientation embedded high order shape functions for
 * the exact sequence elements of all shapes", Comput. Math. Appl. 70 (2015), section 9.1, which MFEM uses since 4.8.
 */
std::unique_ptr<const SpanningSet> make_fuentes_set(int order);

/** x/(1-z), y/(1-z), z; 0, 0, 1 at the apex. */
Point collapsed(const Point& x);

} // namespace elvis_mfem
