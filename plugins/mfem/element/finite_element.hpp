/**
 * @file finite_element.hpp
 * Shape functions of MFEM's elements.
 */
#pragma once

#include "../collection.hpp"
#include "geometry.hpp"

#include <cstddef>
#include <memory>

namespace elvis_mfem {

/** Immutable: any thread may evaluate. */
class FiniteElement {
public:
    virtual ~FiniteElement() = default;
    FiniteElement(const FiniteElement&) = delete;
    FiniteElement& operator=(const FiniteElement&) = delete;

    std::size_t n_dofs() const { return m_n_dofs; }
    /** 1, or the dimension for ND and RT, whose components are those of MFEM's reference frame. */
    std::size_t n_components() const { return m_n_components; }

    /** Values of all shape functions at a reference point of MFEM: values[component * n_dofs + dof]. */
    virtual void evaluate(const Point& x, double* values) const = 0;

protected:
    FiniteElement(std::size_t n_dofs, std::size_t n_components) : m_n_dofs(n_dofs), m_n_components(n_components) {}

private:
    std::size_t m_n_dofs;
    std::size_t m_n_components;
};

/** Throws std::invalid_argument with the reason if MFEM has no such element or if it is not supported. */
std::unique_ptr<const FiniteElement> make_element(const Collection& collection, Geometry geometry);

} // namespace elvis_mfem
