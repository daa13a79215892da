/**
 * @file roots.hpp
 * The first roots of random polynomials by two methods, on the device and on the CPU, against each other.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>

namespace elvis {

struct RootsResult {
    int degree = 0;
    Precision precision = Precision::float64;
    bool on_device = false;
    std::uint64_t n_polynomials = 0;
    /** Polynomials of which a true evaluation confirms a root that the colleague matrix gives (in double precision, on the
     * CPU). */
    std::uint64_t n_with_root = 0;
    /** Those whose first such root each method did not find; eigenvalues that did not converge count, too. */
    std::uint64_t bernstein_missed = 0, colleague_missed = 0;
    /** Roots found before that, confirmed by a true evaluation: missed by the reference. */
    std::uint64_t n_earlier = 0;
    /** Crossings without any root near. */
    std::uint64_t bernstein_false = 0, colleague_false = 0;
    /** Polynomials that come close to zero without crossing, as far as the precision can tell, before the first crossing. */
    std::uint64_t n_touching = 0;
    /** Largest distance of a crossing from the root. */
    double bernstein_error = 0;
    /** Of one core for eight polynomials (one, on the CPU; of the whole device, if it is no processor). */
    double bernstein_nanoseconds = 0, colleague_nanoseconds = 0;
};

/**
 * `n_polynomials` in all, of degrees 2 to 12 in turn, with Chebyshev coefficients a r^k, a uniform in [-1, 1], r in [0.3, 1]
 * for each polynomial. Calls `report` for every degree, on the CPU and on the device in both precisions (the device may be
 * null).
 */
void bench_roots(const Device* device, std::uint64_t n_polynomials, const std::function<void(const RootsResult&)>& report);

} // namespace elvis
