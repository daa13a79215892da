/**
 * @file basis.hpp
 * Values in an element from values at its nodes.
 */
#pragma once

#include "functions.hpp"

#include <plugins/nodal/matrix_cache.hpp>

#include <map>
#include <memory>

namespace elvis_cgns {

using elvis::nodal::Matrix;

/** Any thread may use it. */
class Basis {
public:
    explicit Basis(const ElementType& type);

    const ElementType& type() const { return m_type; }
    std::size_t size() const { return static_cast<std::size_t>(m_to_coefficients.rows()); }
    /** Orders of the native space that contains the functions; pyramids need that of kind `tensor`. */
    std::array<std::uint32_t, 3> native_order() const;

    /** Values at points of elvis/element.h from values at nodes: matrix * values. */
    std::shared_ptr<const Matrix> at(std::span<const double> xi) const;

private:
    Matrix values(std::span<const double> xi) const;

    ElementType m_type;
    Eigen::MatrixXd m_to_coefficients;
    struct Nothing {
        friend bool operator==(const Nothing&, const Nothing&) = default;
    };
    mutable elvis::nodal::MatrixCache<Nothing> m_matrices;
};

/** Of the types of elements in a file; made before threads ask. */
class Bases {
public:
    void add(const ElementType& type);
    const Basis& of(const ElementType& type) const { return *m_bases.at(type); }

private:
    std::map<ElementType, std::unique_ptr<const Basis>> m_bases;
};

} // namespace elvis_cgns
