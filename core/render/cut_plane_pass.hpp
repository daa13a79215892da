/**
 * @file cut_plane_pass.hpp
 * Draws cut planes into the samples of a picture.
 */
#pragma once

#include <core/render/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** Bytes of one core_sample (shaders/library/samples.glsl). */
inline std::size_t sample_bytes(Precision precision) { return 2 * (precision == Precision::float64 ? 8u : 4u) + 16u; }

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class CutPlanePass {
public:
    CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    struct Target {
        const Buffer& samples;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
    };

    /** Draws one plane as surface number `surface`; adds to the counts. */
    void draw(const CutPlaneGeometry& geometry, std::uint32_t surface, std::int32_t component, bool is_discontinuous,
              const Target& target, FrameCounts& counts) const;

private:
    Precision m_precision;
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
};

} // namespace elvis
