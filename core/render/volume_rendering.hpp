/**
 * @file volume_rendering.hpp
 * What a picture shows of the volume itself: light emitted and absorbed along rays (B. Nelson, 2012, equation 6.1).
 */
#pragma once

#include <core/render/surface.hpp>
#include <core/render/volume/transfer_function.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace elvis {

/** How the integral along a segment is found. */
enum class Integrator : std::uint8_t {
    /** As many steps of equal length as it takes to be no longer than `step`, the field taken at the start of each. */
    riemann,
    /** The same steps, with the trapezoidal rule for both integrals. */
    trapezoid,
    /** By the kind of transfer function that the field's range in the segment allows: Nelson's algorithm 2. */
    categories,
    /** Steps halved until the trapezoidal rule agrees with itself: Nelson, section 6.4.4. */
    adaptive_trapezoid,
    /** Cut at the breakpoints; between them the inner integral of a polynomial, and quadrature of high order. */
    exact
};

/** Whether it goes in steps of a given length, not to a tolerance. */
inline bool has_steps(Integrator integrator) {
    return integrator != Integrator::exact && integrator != Integrator::adaptive_trapezoid;
}

struct VolumeRendering {
    /** Which the transfer function is of. */
    FieldChoice field{};
    /** What people know the field by, if not by its own name or text. */
    std::string field_label{};
    TransferFunction transfer;
    /** What annotation tells of its colours; by default those of the transfer function. */
    std::optional<ColorTable> legend{};
    Integrator integrator = Integrator::exact;
    /** World length; of riemann, trapezoid and categories. */
    double step = 0;
    /** What a channel may be off; of adaptive_trapezoid and exact. Pixels in which that was not reached are flagged. */
    double tolerance = 1e-3;
    /** Elements in which the volume is empty, as far as ranges are known, are passed over: with equal pictures, but slower,
     * without. */
    bool skips_by_range = true;
};

} // namespace elvis
