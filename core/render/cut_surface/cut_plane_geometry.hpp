/**
 * @file cut_plane_geometry.hpp
 * A cut plane in one picture, prepared in double precision for the device.
 *
 * Rays are anchored near the plane instead of at the eye: the base of a pixel's ray lies on the plane across the view through a
 * reference point, and is linear in column and row. So single precision rounds numbers of the size of what is seen, not of
 * the distance to the eye or to the world's origin. See shaders/picture/view.glsl.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>

namespace elvis {

/**
 * Error of a crossing along the ray, relative to the volume's diagonal, from which on its pixel is undecided: across a field
 * that varies by ten times its range over the volume it is what colours may be off.
 */
inline constexpr double most_error_along_ray = 3e-5;

struct CutPlaneGeometry {
    /** The uniform block's rows of four, in its order. */
    std::array<std::array<double, 4>, 10> rows{};
    /** Unit normal of the plane, towards the viewer's half space. */
    Vector3 normal{};
    /** Whether the plane's normal as given points away from the viewer. */
    bool is_flipped = false;

    /** How far off along its ray a surface's point is at most, in world length, for its pixel to be decided. */
    void set_most_error(double length) { rows[9][1] = length; }

    /** What was row `row` of the picture becomes its first. Rows are told from the one in the middle: rays stay as they are, to
     * the bit. */
    void begin_at(std::uint32_t row) { rows[8][3] -= row; }
};

/** `centre`: what the hierarchies are relative to. */
CutPlaneGeometry cut_plane_geometry(const CutPlane& plane, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                    const std::array<double, 3>& centre);

/** The uniform block on the device, which write_view() fills. */
Buffer view_buffer(const Device& device, Precision precision);
void write_view(const Buffer& buffer, Precision precision, const CutPlaneGeometry& view);

} // namespace elvis
