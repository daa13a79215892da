/**
 * @file volume_integral.hpp
 * The light that a volume sends along rays, in double precision: equation 6.1 of B. Nelson (2012),
 * integral of color(f) density(f) exp(-integral of density(f)) over the ray, f being its field.
 *
 * The field along a ray's segment in an element is a Chebyshev series, cut where it takes a value at which the transfer
 * function bends. Between two cuts density and colour are linear in the field: the inner integral is that of a polynomial, the
 * outer one is found by adaptive Gauss-Kronrod quadrature.
 */
#pragma once

#include <core/oracle/isosurface/isosurface.hpp>

#include <core/render/volume/transfer_function.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace elvis::oracle {

struct VolumeOptics {
    Scalar scalar;
    TransferFunction transfer;
};

/** Density and colour at a value; at a step, those above it. */
struct OpticalPoint {
    double density = 0;
    std::array<double, 3> rgb{};
};
OpticalPoint optical_point(const TransferFunction& transfer, double value);

/** What a ray brings to the eye. */
struct VolumeLight {
    /** Emitted on the way and not absorbed again. */
    std::array<double, 3> rgb{};
    /** The share of what is behind that arrives. */
    double transmittance = 1;
    /**
     * Estimate for each of them: what quadrature and the field's series leave, without rounding. A series' error moves steps,
     * too, which is not in it.
     */
    double error = 0;
    /** Between neighbouring cuts. */
    std::size_t n_smooth_intervals = 0;
};

/** A volume's light in front of a background, as the program merges layers: colours are not multiplied by opacity. */
Color color_over(const VolumeLight& light, const Color& background);

enum class VolumeFormula {
    emission, ///< the integral as it stands
    /** The same by parts: color(a) - color(b) exp(-depth(b)) + integral of the colour's derivative times exp(-depth). */
    by_parts
};

/** A interval of a ray in the element that owns it there: of `interval`, from `begin` to `end` in [-1, 1]. */
struct OwnedInterval {
    FittedInterval interval;
    double begin = -1, end = 1;
};

/** For one thread. The model must outlive it, and hold no folded elements. */
class VolumeTracer {
public:
    VolumeTracer(const Model& model, const VolumeOptics& optics);

    /** Of the volume in front of a distance. */
    VolumeLight integrate(const Line& line, double until = std::numeric_limits<double>::infinity(),
                          VolumeFormula formula = VolumeFormula::emission);
    /** Of the volume between neighbouring `stops`, ascending: one answer fewer than these. */
    std::vector<VolumeLight> integrate_between(const Line& line, std::span<const double> stops);

    /**
     * From front to back. Where elements overlap, the one entered first owns the ray to its exit; where two are entered at
     * once, as far as rounding tells, either does.
     */
    std::vector<OwnedInterval> owned_intervals(const Line& line, double until = std::numeric_limits<double>::infinity());

    /** The field's smallest and largest value among samples of all elements. */
    double low() const { return m_tracer.low(); }
    double high() const { return m_tracer.high(); }
    /** See IsosurfaceTracer. */
    std::uint64_t n_failures() const { return m_tracer.n_failures(); }

private:
    void add(const OwnedInterval& owned, VolumeFormula formula, VolumeLight& light) const;

    TransferFunction m_transfer;
    /** All values of the transfer function's points, ascending, each once. */
    std::vector<double> m_breakpoints;
    IsosurfaceTracer m_tracer;
};

/** Answers for pixels of a picture, by as many threads as the machine has cores. */
struct VolumePicture {
    /** Row by row from the top one. */
    std::vector<std::size_t> pixels;
    /** One for each of them. */
    std::vector<VolumeLight> answers;
    std::uint64_t n_failures = 0;
    double seconds = 0;
};

/**
 * `pixels`: those that are wanted; all if empty. `depths`: one a pixel of the picture, beyond which the volume is hidden (NaN:
 * it is not); none is hidden if empty.
 */
VolumePicture draw_volume(const Model& model, const VolumeOptics& optics, const Camera& camera, std::uint32_t width,
                          std::uint32_t height, std::vector<std::size_t> pixels = {}, std::span<const double> depths = {});

/** `count` different pixels of `n_pixels`, or all if there are no more, ascending; the same for the same seed. */
std::vector<std::size_t> sampled_pixels(std::size_t n_pixels, std::size_t count, std::uint64_t seed);

} // namespace elvis::oracle
