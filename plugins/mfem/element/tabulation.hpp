/**
 * @file tabulation.hpp
 * Shape functions at sets of points, kept because a conversion asks for the same points in every element of a class.
 */
#pragma once

#include "finite_element.hpp"

#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

namespace elvis_mfem {

/** Any thread may use it. */
class Tabulation {
public:
    Tabulation(std::unique_ptr<const FiniteElement> element, Geometry geometry)
        : m_element(std::move(element)), m_geometry(geometry) {}

    const FiniteElement& element() const { return *m_element; }

    /**
     * Values of a field at ElVis's reference points: out[point * stride + component]. `dofs` are those of n_copies scalar
     * fields, one after the other, each a component of its own; or of one vector field.
     */
    void combine(std::span<const double> xi, std::span<const double> dofs, std::size_t n_copies, double* out,
                 std::size_t stride) const;

private:
    struct Entry {
        std::vector<double> xi;
        /** [point][component][dof]. */
        std::vector<double> values;
    };
    std::shared_ptr<const Entry> find(std::span<const double> xi) const;
    void tabulate(std::span<const double> xi, double* values) const;

    std::unique_ptr<const FiniteElement> m_element;
    Geometry m_geometry;
    mutable std::shared_mutex m_mutex;
    mutable std::vector<std::shared_ptr<const Entry>> m_entries;
    /** Numbers in them. */
    mutable std::size_t m_n_kept = 0;
};

} // namespace elvis_mfem
