/**
 * @file plate.hpp
 * Elements of two dimensions as plates, so that what finds points in solid elements finds them in these, too.
 *
 * A plate is the hexahedron over a quadrilateral, or the prism over a triangle: its middle is the element, and its third
 * direction is along the normals, up to about the element's size on either side.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/newton.hpp>
#include <core/volume/element/flat_height.hpp>

#include <cstdint>

namespace elvis {

/** An element as a solid: itself, or its plate. The volume, which evaluates on the CPU, must outlive it. */
class SolidElement {
public:
    SolidElement(const RuntimeVolume& volume, std::uint64_t element);

    elvis_shape shape() const { return m_solid_shape; }
    /** Of the solid; its points are those of shape(). */
    MappingFunction mapping() const;
    /** The element's own reference point, of a point of the solid. */
    Vector3 own(const Vector3& solid) const;
    /** The other way; into the middle of a plate. */
    Vector3 solid(const Vector3& own) const;
    /** How far a point lies beyond the element's faces, in its own reference coordinates; less than 0 inside. */
    double excess(const Vector3& own) const;
    /** By Newton's method, in the element's own reference coordinates: inside if the target lies in the element. */
    std::vector<Inversion> invert(std::span<const Vector3> targets) const;

private:
    bool is_plate() const { return m_shape == ELVIS_SHAPE_QUADRILATERAL || m_shape == ELVIS_SHAPE_TRIANGLE; }
    /** Which of the solid's coordinates is along the normals. */
    std::size_t normal_axis() const { return m_shape == ELVIS_SHAPE_TRIANGLE ? 1 : 2; }
    void evaluate_plate(std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) const;

    const RuntimeVolume& m_volume;
    std::uint64_t m_element;
    elvis_shape m_shape, m_solid_shape;
    /** Of a plate: the element's size, half its thickness. */
    double m_size = 1;
};

} // namespace elvis
