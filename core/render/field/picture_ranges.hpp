/**
 * @file picture_ranges.hpp
 * What a picture needs to know of a volume before anything is drawn.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/surface.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Where a volume lies, and which values its fields take: of one on a device (volume_ranges.hpp), or of one in parts. */
class PictureRanges {
public:
    virtual ~PictureRanges() = default;

    /** Bounds of the whole volume: min x y z, max x y z. */
    virtual const std::array<double, 6>& bounds() const = 0;
    /** How far the volume reaches in every direction (core/volume/outline.hpp). */
    virtual const std::vector<Vector3>& outline() = 0;
    /** Extrema of a field (component, magnitude or expression) over the volume at a time step: what colours go by. */
    virtual const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step) = 0;
    /** Encloses those: certified where the plugin says so, and several times wider. */
    virtual FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr) = 0;
    /** About what rounding costs its values; 0 where the range is certainly more. */
    virtual double value_rounding(const FieldChoice& field, std::uint32_t time_step) = 0;

    /** Of numbers that follow from elements of which other processes have others: each becomes the smallest that one has. */
    virtual void take_minima(std::span<double>) {}
};

} // namespace elvis
