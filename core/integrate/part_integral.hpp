/**
 * @file part_integral.hpp
 * The integral over one part of the domain: an element, a face, an edge, or the part of a plane or isosurface in an element.
 */
#pragma once

#include <core/integrate/adaptive_sum.hpp>

#include <cstdint>

namespace elvis {

/** An element, or a face of one. */
struct DomainPart {
    std::uint64_t element = 0;
    ElementPart part;
    std::uint32_t element_class = 0;
};

/** How many Gauss points a direction a part takes. */
struct PartRule {
    unsigned n_points = 1;
    /** The integral's value, its measure: exact with so many points. */
    bool is_value_exact = false, is_measure_exact = false;
    /** How often it is divided at most. */
    unsigned most_depth = 12;
};

PartSums integrate_part(const Integrand& integrand, const DomainPart& part, const PartRule& rule, const SumTolerance& tolerance,
                        std::uint64_t& n_evaluations);

/** `level`: of one expression, which has a gradient(). */
PartSums integrate_level(const Integrand& integrand, const DomainPart& part, const ElementSampler& level, double isovalue,
                         const SumTolerance& tolerance, std::uint64_t& n_evaluations);

} // namespace elvis
