/**
 * @file convergence_scene.hpp
 * Volumes, transfer functions and pictures on which integrators are measured.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace elvis {

/** Three tents of density, each as wide as this share of the field's range, nothing between; a ray loses about a quarter in
 * each. */
TransferFunction peaks_in(const FieldRange& range, double width, double diagonal);
/** Linear, with no breakpoint in the range. */
TransferFunction ramp_in(const FieldRange& range, double diagonal);
/** Nothing, then over `width` up to a density of 1: two breakpoints. */
TransferFunction edge_at(double value, double width);

/** A picture of all of a volume, from outside, on an opaque background. */
FrameRequest volume_picture(const std::array<double, 6>& bounds, std::uint32_t size);

/** Largest difference of a channel, but for pixels of the reference that drivers cut short. */
double largest_difference(const Frame& frame, const Frame& reference);

/** One hexahedron, or cells of a shape, of [-1,1] x [-1,1] x [-2,4] with the field x^2 + y^2 + z^2. */
RuntimeVolume sphere_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& shape,
                            const std::array<std::uint32_t, 3>& n);

/** A count of a frame for each of so many pixels. */
double a_pixel(std::uint64_t count, std::uint64_t n_pixels);

/** A volume in one precision with one transfer function, drawn in many ways. */
class ConvergenceScene {
public:
    /** Of references, in double precision; and of samples of integrators that only have steps, so that these are all of their
     * error. */
    static constexpr double reference_tolerance = 1e-9;
    /** What the comparison asks for: 8-bit colours, with room. */
    static constexpr double wanted_error = 1e-3;

    ConvergenceScene(const Device& device, const RuntimeVolume& volume, Precision precision, std::uint32_t size);

    /** Pixels of rays that meet the volume. */
    std::uint64_t n_pixels() const { return m_n_pixels; }

    double diagonal() const { return m_diagonal; }
    const FieldRange& range() const { return m_range; }
    /** Of what a plane through the middle shows all but the least and the greatest fiftieth: where something is seen of the
     * volume. */
    const FieldRange& usual_range() const { return m_usual_range; }
    FrameRequest& request() { return m_request; }
    VolumeRendering& rendering() { return *m_request.volume; }

    /** Peaks each 1 % of the field's range wide, where there is something to see of them. */
    TransferFunction narrow_peaks() const;

    Frame draw(Integrator integrator, double step, double tolerance);
    /** As exact as loops of drivers allow; `tolerance` is what that was. */
    Frame draw_reference(double& tolerance);

private:
    Renderer m_renderer;
    FrameRequest m_request;
    double m_diagonal;
    FieldRange m_range, m_usual_range;
    std::uint64_t m_n_pixels = 0;
};

} // namespace elvis
