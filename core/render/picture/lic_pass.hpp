/**
 * @file lic_pass.hpp
 * Line integral convolution on a surface, in the picture.
 *
 * At the point that each pixel shows, the vector is evaluated in the element's own basis. Its part in the tangent plane of the
 * true surface is projected into the picture by the exact derivative of the camera's projection
 * (shaders/picture/lic_directions.comp). Noise, a hash of the pixel's place in the whole picture, is then averaged along the
 * curve through each pixel that follows these directions (shaders/picture/lic.comp, with the sources). Nothing is sampled on a
 * mesh: what is approximate is the curve between pixels: directions are bilinear there, and the midpoint rule follows them in
 * steps of half a pixel.
 *
 * Curves end where the surface does, where it is folded in front of itself or turns by more than some 60 degrees from one pixel
 * to the next, where directions turn by more than 120 degrees between pixels (as at stagnation points), where there is no
 * vector, and where the vector is zero within its rounding: there noise stays as it is.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace elvis {

class LicPass {
public:
    LicPass(const Device& device, Precision precision);

    /** `values` shows what `layer` shows, with no flags: for passes that evaluate components. */
    void begin(const Layer& layer, const Layer& values);
    /** One of the vector's three components, which are in `values`. */
    void take(const Layer& layer, const Layer& values, std::uint32_t component) const;

    /** What the vectors are on the device. */
    struct Vectors {
        /** Which their components lack there. */
        std::array<double, 3> offsets{};
        /** How far off a vector may be, as a length. */
        double error = 0;
    };
    /** Averages along the vectors that were taken. `first_row`: of the whole picture, in which the layer begins. */
    void convolve(const Layer& layer, const CutPlaneGeometry& view, bool is_plane, const Vectors& vectors, const Lic& lic,
                  std::uint32_t first_row);

    /** One real a pixel: by what its colour is to be multiplied. Where the surface has no vector it is 1. */
    const Buffer& shades() const { return *m_shades; }

private:
    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_owners, m_component, m_directions, m_convolution;
    Buffer m_view, m_numbers;
    /** Kept from frame to frame. */
    std::optional<Buffer> m_vectors, m_pixels, m_shades;
};

} // namespace elvis
