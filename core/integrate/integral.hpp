/**
 * @file integral.hpp
 * Integrals of fields and expressions over a volume, its boundary, planes and isosurfaces, and fluxes through these, in double
 * precision, in the true basis on the true geometry.
 *
 * Quadrature in reference coordinates, element by element. Where integrand and measure are polynomials, the rule is exact and
 * the error is that of rounding. Elsewhere two rules of different order are compared, and what is off too much is divided.
 * Planes and isosurfaces: core/integrate/level_rule.hpp.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

struct IntegralRequest {
    enum class Domain {
        volume,    ///< all elements; of surfaces, their area
        boundary,  ///< faces without neighbour, of `groups` or of all
        plane,     ///< a x + b y + c z + d = 0
        isosurface ///< where `level_field` is `isovalue`
    };
    Domain domain = Domain::volume;
    /** Field, component or expression; empty: 1. With `is_flux` a vector. */
    std::string field;
    /**
     * Integrates the vector's component along the normal: out of the volume, along (a, b, c), or to larger values of the level
     * field. Not over volumes.
     */
    bool is_flux = false;
    std::vector<std::string> groups;
    std::array<double, 4> plane{};
    std::string level_field;
    double isovalue = 0;
    std::uint32_t time_step = 0;
    /** Of the error, relative to the integral of the integrand's magnitude. */
    double tolerance = 1e-9;
};

struct Integral {
    double value = 0;
    /** The value is off by about this much: the difference of two rules, or rounding if it is exact. */
    double error = 0;
    /** Volume, area or length of what is integrated over, and its error. */
    double measure = 0, measure_error = 0;
    /** Both errors are within the tolerance. */
    bool is_converged = false;
    /** The rule is exact for the value. */
    bool is_exact = false;
    /** Parts of elements, or faces, that count. */
    std::uint64_t n_parts = 0;
    std::uint64_t n_evaluations = 0;
    /** Elements in which the Jacobian determinant is negative at some of the points; their measure counts as positive. */
    std::uint64_t n_inverted = 0;
    /** Boxes of planes and isosurfaces that stay undecided; the error holds what they could add. */
    std::uint64_t n_unresolved = 0;
};

/** Throws Error for what cannot be integrated. The plugin has to evaluate on the CPU. */
Integral integrate(const RuntimeVolume& volume, const IntegralRequest& request, const TaskControl& control);

} // namespace elvis
