/**
 * @file values_by_place.hpp
 * Surfaces that show what the device cannot evaluate: fields of another volume, found by place.
 *
 * The device finds the surface with a field of its own; then, of each pixel, the point is taken from there, and the processor
 * evaluates what is to be seen at it, in double precision.
 */
#pragma once

#include <core/probe/cpu_evaluator.hpp>
#include <core/probe/element_finder.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>

namespace elvis {

class ValuesByPlace {
public:
    /** Both must outlive it. The volume evaluates on the CPU. */
    ValuesByPlace(const Device& device, const RuntimeVolume& volume);

    /**
     * Of all pixels that show the surface: values less `offset`, into the samples of the layer. Those that are no number, as
     * outside of the other volume, are flagged, and so are those where elements of the other volume meet whose values differ.
     * The target has places, unless the surface is a plane.
     */
    void draw(const Surface& surface, const FrameRequest& request, double offset, Precision precision,
              const LayerTarget& target);

    /** What is lost of positions and of values. */
    struct Rounding {
        double reach, value;
    };

private:
    /** Where a field that is found by place has another value on the other side of a face of its mesh. */
    void mark_jumps(const FieldChoice& field, std::uint32_t time_step, const Rounding& rounding,
                    std::span<const ReferencePoint> points, std::span<std::uint8_t> jumps);
    template <class Real>
    void draw(const Surface& surface, const FrameRequest& request, Real offset, const LayerTarget& target);
    /** Of a point of a plane in the element of that number, or else in one that holds it; nothing outside. */
    std::optional<ReferencePoint> place_in(std::uint32_t number, const Vector3& position) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    ElementFinder m_finder;
    CpuEvaluator m_evaluator;
    Background m_background;
};

} // namespace elvis
