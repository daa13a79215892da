/**
 * @file element_sums.hpp
 * What quadrature points of an element add to an integral.
 */
#pragma once

#include <core/integrate/element_sampler.hpp>
#include <core/integrate/reference_rule.hpp>

namespace elvis {

struct Sums {
    double value = 0;
    /** Of the integrand's magnitude. */
    double size = 0;
    double measure = 0;
    bool is_inverted = false;

    Sums& operator+=(const Sums& other);
};

/** What is integrated. May be used by several threads at once. */
class Integrand {
public:
    enum class Kind {
        one,    ///< measure alone: no expression
        scalar, ///< one expression
        flux    ///< three expressions, the components of a vector
    };
    Integrand(const ElementSampler& sampler, Kind kind) : m_sampler(sampler), m_kind(kind) {}

    /**
     * Weights are those of an element, vectors those of a surface or of edges. A surface in an element of two dimensions is
     * one in the plate of thickness 1 around it: as large as the line is long in which it meets the element.
     */
    Sums sum(std::uint64_t element, elvis_shape shape, const ReferencePoints& points) const;

private:
    const ElementSampler& m_sampler;
    Kind m_kind;
};

} // namespace elvis
